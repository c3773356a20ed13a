"""The panel of the page Power."""
