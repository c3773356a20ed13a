"""One file a layer of the scene; each holds a constant ``LAYER``."""
