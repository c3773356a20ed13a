"""The page "orientation"."""
