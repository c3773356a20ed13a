"""Questions, one file for each kind, with a constant ``QUESTION``."""
