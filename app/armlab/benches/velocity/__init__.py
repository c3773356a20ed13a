"""The tab of velocity, with one folder for each page."""
