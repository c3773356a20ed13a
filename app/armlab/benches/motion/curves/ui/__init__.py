"""The panel of the page Curves."""
