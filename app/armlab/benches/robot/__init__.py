"""The tab of robot: one folder a page."""
