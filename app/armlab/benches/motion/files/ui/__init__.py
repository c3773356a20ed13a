"""The panel of the page Files."""
