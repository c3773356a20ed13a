"""The tab of view: one folder a page."""
