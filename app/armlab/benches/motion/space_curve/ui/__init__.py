"""What is seen of "space_curve": its page and its part of the scene."""
