"""The page "Speeds"."""
