"""One file a closed form; each holds a constant ``CLOSED``. They are written on joint axes (`armlab.kin.ik.screws`)."""
