"""The panel of the page Laws."""
