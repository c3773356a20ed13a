"""The panel of the page History."""
