"""What is seen of "Microscope": its page and its part of the scene."""
