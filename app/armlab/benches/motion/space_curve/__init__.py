"""The page "space_curve"."""
