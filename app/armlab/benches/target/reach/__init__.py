"""The page "reach"."""
