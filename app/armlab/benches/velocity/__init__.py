"""The tab of velocity: one folder a page."""
