"""The page "table"."""
