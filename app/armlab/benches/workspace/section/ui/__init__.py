"""What is seen of "section": its page and its part of the scene."""
