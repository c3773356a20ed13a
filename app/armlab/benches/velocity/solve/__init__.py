"""The page "solve"."""
