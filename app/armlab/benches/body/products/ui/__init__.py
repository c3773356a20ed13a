"""The panel of the page Products in symbols, and its part of the scene."""
