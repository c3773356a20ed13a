"""The tab of lessons: one folder a page."""
