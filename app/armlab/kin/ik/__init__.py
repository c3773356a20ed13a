"""Inverse kinematics: `solve` for one solution, `judge` for what a configuration is worth, `methods` for the ways."""

from armlab.kin.ik.method import Method, method_named, methods
from armlab.kin.ik.solve import IkResult, solve
from armlab.kin.ik.verdict import Verdict, judge

__all__ = ["IkResult", "Method", "Verdict", "judge", "method_named", "methods", "solve"]
