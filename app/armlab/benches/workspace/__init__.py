"""The tab of workspace: one folder a page."""
