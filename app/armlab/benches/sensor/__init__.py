"""The tab of sensors and of measuring with them, with one folder for each page."""
