"""The tab of lessons, with one folder for each page."""
