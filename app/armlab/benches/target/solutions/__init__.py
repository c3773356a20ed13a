"""The page "solutions"."""
