"""The tab of motion: one folder a page."""
