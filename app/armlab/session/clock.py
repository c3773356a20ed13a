"""The clock of sessions: seconds since 1970, which no longer jumps when the computer's clock is set."""

import time

_BEGAN = time.time() - time.monotonic()


def now() -> float:
    """Return the seconds since 1970 as they have passed since the lab began."""
    return _BEGAN + time.monotonic()
