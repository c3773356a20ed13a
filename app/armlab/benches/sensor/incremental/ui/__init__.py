"""Everything that the page Incremental encoder draws."""
