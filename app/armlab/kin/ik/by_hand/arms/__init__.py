"""Kinds of arms that are solved by hand, one file each, with a constant ``WORKED``."""
