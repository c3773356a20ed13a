"""Scalar expressions of an arm, and the three ways to use them: scalar code, array tape, printed formula."""
