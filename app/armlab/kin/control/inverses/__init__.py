"""Inverses of the differential kinematics, one file each, with a constant ``INVERSE``."""
