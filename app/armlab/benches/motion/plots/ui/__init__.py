"""What is seen of the page Plots: its panel."""
