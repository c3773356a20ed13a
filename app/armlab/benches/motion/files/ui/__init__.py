"""What is seen of the page Files: its panel."""
