"""What is seen of "trainer": its page and its part of the scene."""
