"""One file a bench with examples; each holds a constant ``BENCH``."""
