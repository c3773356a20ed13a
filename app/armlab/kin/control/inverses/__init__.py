"""One file an inverse of the differential kinematics; each holds a constant ``INVERSE``."""
