"""The page "help"."""
