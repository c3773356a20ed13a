"""One file a kind of question; each holds a constant ``QUESTION``."""
