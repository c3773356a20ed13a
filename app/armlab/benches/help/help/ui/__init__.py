"""What is seen of "help": its page and its part of the scene."""
