"""The page "{_hint(name)}"."""
