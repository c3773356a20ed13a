"""The tab of help, with one folder for each page."""
