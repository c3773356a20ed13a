"""The benches: one folder a tab, one sub-folder a page with all that belongs to it."""
