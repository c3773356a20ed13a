"""What is seen of "Runs": its page and its part of the scene."""
