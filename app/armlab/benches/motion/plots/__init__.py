"""The page "Plots"."""
