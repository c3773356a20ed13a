"""What is seen of "tool": its page and its part of the scene."""
