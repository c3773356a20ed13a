"""The page "choose"."""
