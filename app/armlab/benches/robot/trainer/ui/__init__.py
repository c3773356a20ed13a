"""The panel of the page Trainer, and its part of the scene."""
