"""Parts of the state that belong to lessons, one file for each topic, with a constant ``PART``."""
