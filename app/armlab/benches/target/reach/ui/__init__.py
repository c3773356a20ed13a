"""What is seen of "reach": its page and its part of the scene."""
