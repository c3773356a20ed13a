"""What is seen of "{_hint(name)}": its page and its part of the scene."""
