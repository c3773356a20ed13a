"""The panel of the page Pictures, and its part of the scene."""
