"""What is seen of "Speeds": its page and its part of the scene."""
