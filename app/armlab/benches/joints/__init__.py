"""The tab of joints: one folder a page."""
