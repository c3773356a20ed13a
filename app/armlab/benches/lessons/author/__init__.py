"""The page "author"."""
