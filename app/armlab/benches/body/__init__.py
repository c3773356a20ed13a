"""The tab of a body that the student turns, with one folder for each page."""
