"""The tab of iterate, with one folder for each page."""
