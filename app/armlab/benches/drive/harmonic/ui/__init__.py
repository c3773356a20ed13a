"""The panel of the page Harmonic drive, and its part of the scene."""
