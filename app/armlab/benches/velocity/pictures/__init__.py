"""The page "pictures"."""
