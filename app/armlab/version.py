"""Which version of the lab this is."""

VERSION = "0.1.0"
