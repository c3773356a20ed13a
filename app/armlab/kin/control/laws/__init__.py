"""Control laws, one file each, with a constant ``LAW``."""
