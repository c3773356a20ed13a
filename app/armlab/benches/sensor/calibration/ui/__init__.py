"""Everything that the page Calibration draws."""
