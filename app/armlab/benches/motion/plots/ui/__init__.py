"""What is seen of "Plots": its page and its part of the scene."""
