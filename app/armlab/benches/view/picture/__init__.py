"""The page "picture"."""
