"""The page "Notes 1.50-1.52, 1.58 corrected"."""
