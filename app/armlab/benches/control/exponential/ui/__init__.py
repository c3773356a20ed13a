"""What is seen of "Notes 1.50-1.52, 1.58 corrected": its page and its part of the scene."""
