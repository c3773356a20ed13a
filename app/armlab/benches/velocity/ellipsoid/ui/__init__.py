"""What is seen of "Singular values of J, notes 5.152": its page and its part of the scene."""
