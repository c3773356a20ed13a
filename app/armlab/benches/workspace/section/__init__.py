"""The page "section"."""
