"""The panel of the page Plots."""
