"""The panel of the page DH table, and its part of the scene."""
