"""What is seen of "by_hand": its page and its part of the scene."""
