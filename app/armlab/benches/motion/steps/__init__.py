"""The page "steps"."""
