"""What is seen of "dexterous": its page and its part of the scene."""
