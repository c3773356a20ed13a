"""What is seen of "Steps": its page and its part of the scene."""
