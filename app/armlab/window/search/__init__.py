"""The one search of the lab."""
