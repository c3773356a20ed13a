"""The panel of the page Export."""
