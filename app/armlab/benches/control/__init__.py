"""The tab of control: one folder a page."""
