"""The page "{hint}"."""
