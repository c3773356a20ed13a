"""The tab of iterate: one folder a page."""
