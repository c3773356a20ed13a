"""The page "statics"."""
