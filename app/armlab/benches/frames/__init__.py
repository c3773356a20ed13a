"""The tab of frames and the transforms between them, with one folder for each page."""
