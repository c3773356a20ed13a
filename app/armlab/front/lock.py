"""A lock that lets only one lab use a folder: two would overwrite each other's students."""

from __future__ import annotations

import errno
import logging
import os
import sys
from pathlib import Path

from armlab.errors import ArmlabError

log = logging.getLogger(__name__)

_HELD = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)
"""Error numbers of systems for a lock that another process holds."""


class FolderInUse(ArmlabError):
    """Another lab keeps its students in this folder."""


class FolderLock:
    """Holds a folder from its making until `release`, at the latest until the process ends, however it ends.

    Parameters
    ----------
    folder : Path
        Made when it is not there.

    Raises
    ------
    FolderInUse
        Somebody else holds it.
    OSError
        The folder cannot be written.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        self._handle = os.open(folder / "lock", os.O_RDWR | os.O_CREAT, 0o600)
        try:
            _lock(self._handle)
        except OSError as error:
            if error.errno in _HELD:
                os.close(self._handle)
                raise FolderInUse(
                    f"{folder} is in use by another lab; stop that one or choose another with --state DIR"
                ) from None
            # Some network folders know no locks; a lab without one is better than none.
            log.warning("%s cannot be locked (%s); open no second lab on it", folder, error.strerror)

    def release(self) -> None:
        """Release the folder."""
        os.close(self._handle)


if sys.platform == "win32":
    import msvcrt

    def _lock(handle: int) -> None:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(handle: int) -> None:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
