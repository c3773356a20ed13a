"""The form of a link with a shared state, by which the front lets nothing else through to be unpacked."""

from __future__ import annotations

import re

LONGEST = 1500
"""Most characters of a text."""

TEXT = re.compile(rf"[A-Za-z0-9_-]{{2,{LONGEST}}}\Z")
"""Pattern of a shared state: letters that need no escape in an address, and a length that people can send."""
