"""The panel of the page DH film, and its part of the scene."""
