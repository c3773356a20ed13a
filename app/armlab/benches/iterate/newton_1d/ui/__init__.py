"""What is seen of "Notes 4.106-4.110; printed there without x_n": its page and its part of the scene."""
