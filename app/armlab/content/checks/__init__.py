"""Checks, one file for each kind, with a constant ``CHECK``."""
