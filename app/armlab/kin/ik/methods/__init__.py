"""One file a method; each holds a constant ``METHOD``."""
