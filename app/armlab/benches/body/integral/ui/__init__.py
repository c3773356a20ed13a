"""The panel of the page Integral of ω, and its part of the scene."""
