"""Compiled methods, one file each, with a constant ``METHOD``."""
