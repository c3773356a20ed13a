"""The clock of sessions: seconds since 1970, which no longer jumps when the computer's clock is set."""

import time


def steady() -> float:
    """Return seconds that also pass while the computer sleeps, finer than a hundredth of a millisecond."""
    # Only Linux has the first, and only macOS goes on counting in the second; what `time.monotonic` counts stands still
    # there while a laptop is shut, and on Windows it may move in steps of 16 milliseconds.
    kind = getattr(time, "CLOCK_BOOTTIME", getattr(time, "CLOCK_MONOTONIC_RAW", None))
    return time.perf_counter() if kind is None else time.clock_gettime(kind)


_BEGAN = time.time() - steady()


def now() -> float:
    """Return the seconds since 1970 as they have passed since the lab began."""
    return _BEGAN + steady()
