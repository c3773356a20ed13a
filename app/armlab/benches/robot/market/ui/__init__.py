"""The panel of the page Market."""
