"""The page "dexterous"."""
