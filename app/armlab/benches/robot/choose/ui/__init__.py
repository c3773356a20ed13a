"""What is seen of "choose": its page and its part of the scene."""
