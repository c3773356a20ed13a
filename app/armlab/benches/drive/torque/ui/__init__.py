"""The panel of the page Torque, and its part of the scene."""
