"""The panel of the page Frame chain, and its part of the scene."""
