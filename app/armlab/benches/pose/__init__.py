"""The tab of pose, with one folder for each page."""
