"""What a link with a shared state looks like from outside; the front lets nothing else through to be unpacked."""

from __future__ import annotations

import re

LONGEST = 1500
"""Characters of a text: no more than people can send around."""

TEXT = re.compile(rf"[A-Za-z0-9_-]{{2,{LONGEST}}}\Z")
"""Letters that need no escape in an address."""
