"""One file an iterative method; each holds a constant ``ITERATION``."""
