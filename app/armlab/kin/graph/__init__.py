"""Scalar expressions of an arm and their three uses: scalar code, code for arrays, and printed formulas."""
