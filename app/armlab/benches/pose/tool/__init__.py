"""The page "tool"."""
