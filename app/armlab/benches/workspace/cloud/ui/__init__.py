"""What is seen of "Reach": its page and its part of the scene."""
