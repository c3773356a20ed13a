"""One file a topic: a part of the state and the commands that change it. Each holds a constant ``PART``."""
