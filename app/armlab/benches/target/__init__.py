"""The tab of target: one folder a page."""
