"""Iterative methods, one file each, with a constant ``ITERATION``."""
