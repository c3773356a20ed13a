"""The panel of the page Interpolation."""
