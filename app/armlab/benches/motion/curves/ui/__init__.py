"""What is seen of the page Curves: its panel."""
