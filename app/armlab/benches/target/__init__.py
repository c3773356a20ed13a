"""The tab of target, with one folder for each page."""
