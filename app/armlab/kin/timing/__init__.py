"""Timing laws: one file a kind; each holds a constant ``LAW``. What a law is: `armlab.kin.motion.law_types`."""
