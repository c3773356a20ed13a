"""What is seen of "{escaped(hint)}": its page and its part of the scene."""
