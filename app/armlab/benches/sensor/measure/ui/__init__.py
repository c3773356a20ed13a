"""Everything that the page Accuracy draws."""
