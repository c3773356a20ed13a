"""The page "Reach"."""
