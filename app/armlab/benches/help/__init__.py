"""The tab of help: one folder a page."""
