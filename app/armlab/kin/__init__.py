"""The kinematics core: NumPy and SciPy only; no files, no clock, no plots, no globals."""
