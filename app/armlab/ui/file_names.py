"""Names of files that the browser saves."""

from __future__ import annotations

import re

from armlab.content.robots import KEY


def file_name(name: str) -> str:
    """Return a name that can be used for a robot file.

    >>> file_name("PUMA 560"), file_name("χ")
    ('puma_560', 'my_arm')
    """
    key = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")[:64]
    return key if KEY.match(key) else "my_arm"
