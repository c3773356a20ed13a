"""The page "index"."""
