"""The tab of pose: one folder a page."""
