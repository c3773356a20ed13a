"""The judge of inverse kinematics: arms and poses, a search of its own, and what it has against an answer.

It shares nothing with the solvers it judges but the description of an arm.
"""
