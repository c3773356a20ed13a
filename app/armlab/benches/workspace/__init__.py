"""The tab of workspace, with one folder for each page."""
