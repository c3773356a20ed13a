"""The page "laws"."""
