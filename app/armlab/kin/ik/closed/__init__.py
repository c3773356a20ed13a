"""Closed forms, one file each, with a constant ``CLOSED``; they use the joint axes (`armlab.kin.ik.screws`)."""
