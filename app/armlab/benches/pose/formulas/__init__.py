"""The page "formulas"."""
