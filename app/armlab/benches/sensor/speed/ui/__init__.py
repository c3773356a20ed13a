"""Everything that the page Encoder velocity draws."""
