"""What is seen of "turning": its page and its part of the scene."""
