"""Workspaces: where a tool can be, and in which orientations (sections 4.2 and 4.3.1 of the notes)."""
