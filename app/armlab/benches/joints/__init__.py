"""The tab of joints, with one folder for each page."""
