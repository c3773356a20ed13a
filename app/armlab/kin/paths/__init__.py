"""Geometric paths: one file a kind; each holds a constant ``PATH``. What a path is: `armlab.kin.motion.path_types`."""
