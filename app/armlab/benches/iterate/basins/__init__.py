"""The page "{escaped(hint)}"."""
