"""Timing laws, one file each, with a constant ``LAW``; see `armlab.kin.motion.law_types`."""
