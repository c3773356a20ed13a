"""Layers of the scene, one file each, with a constant ``LAYER``."""
