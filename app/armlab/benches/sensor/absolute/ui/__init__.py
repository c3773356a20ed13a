"""Everything that the page Absolute encoder draws, and what the pages of encoders share."""
