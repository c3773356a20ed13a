"""The tab of view, with one folder for each page."""
