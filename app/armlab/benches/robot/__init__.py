"""The tab of robot, with one folder for each page."""
