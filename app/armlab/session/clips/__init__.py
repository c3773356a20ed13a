"""One file a film or run; each holds a constant ``CLIP``."""
