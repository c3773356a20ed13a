"""Everything that the page Speed draws."""
