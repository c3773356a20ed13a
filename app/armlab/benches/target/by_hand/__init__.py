"""The page "by_hand"."""
