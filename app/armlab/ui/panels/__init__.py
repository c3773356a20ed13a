"""One file a panel; each holds a constant ``PANEL``."""
