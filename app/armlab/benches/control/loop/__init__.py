"""The page "{title}"."""
