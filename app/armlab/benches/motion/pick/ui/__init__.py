"""The panel and the drawings of the page Pick & place."""
