"""The page "Steps"."""
