"""The page "files"."""
