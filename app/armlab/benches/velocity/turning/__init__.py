"""The page "turning"."""
