"""The panel of the page Share, and its part of the scene."""
