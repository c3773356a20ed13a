"""The panel of the page Accuracy, and its points in the scene."""
