"""One file a kind of check; each holds a constant ``CHECK``."""
