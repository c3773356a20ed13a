"""The page "share"."""
