"""Parts of the state with their commands, one file for each topic, with a constant ``PART``."""
