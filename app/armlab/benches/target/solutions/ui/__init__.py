"""What is seen of "solutions": its page and its part of the scene."""
