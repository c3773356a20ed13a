"""Geometric paths, one file each, with a constant ``PATH``; see `armlab.kin.motion.path_types`."""
