"""The tab of motion, with one folder for each page."""
