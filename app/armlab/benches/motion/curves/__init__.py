"""The page "curves"."""
