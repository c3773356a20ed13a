"""What is seen of "sliders": its page and its part of the scene."""
