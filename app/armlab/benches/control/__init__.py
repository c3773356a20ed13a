"""The tab of control, with one folder for each page."""
