"""What is seen of the page Laws: its panel."""
