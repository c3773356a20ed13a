"""Signed tokens that identify browsers: the lab chooses them, not the browser."""

from __future__ import annotations

import hashlib
import hmac
import os
import secrets
import tempfile
from pathlib import Path

SECRET_BYTES = 32


class Tokens:
    """Makes and checks the cookie that names a browser.

    Parameters
    ----------
    secret : bytes
        Kept beside the sessions; with another secret every browser is a stranger.
    """

    def __init__(self, secret: bytes) -> None:
        self._secret = secret
        # Cookies do not know ports: two labs on one host would overwrite each other's.
        self.cookie = f"armlab-{hashlib.sha256(secret).hexdigest()[:8]}"

    def new(self) -> str:
        """Return the cookie value of a new browser."""
        return self._signed(secrets.token_urlsafe(18))

    def read(self, value: str | None) -> str | None:
        """Return the token in a cookie value, or None when it was not made here."""
        token, _, _ = (value or "").rpartition(".")
        if not token or not hmac.compare_digest(self._signed(token).encode(), (value or "").encode()):
            return None
        return token

    def _signed(self, token: str) -> str:
        return f"{token}.{hmac.new(self._secret, token.encode(), hashlib.sha256).hexdigest()[:32]}"


def kept_secret(folder: Path | None) -> bytes:
    """Return the secret of a folder, made on first use and readable by its owner only; without a folder a new one.

    One that is too short was cut off or made by hand; cookies could be forged with it, so it is replaced.
    """
    fresh = secrets.token_bytes(SECRET_BYTES)
    if folder is None:
        return fresh
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    path = folder / "secret"
    if path.exists() and len(kept := path.read_bytes()) >= SECRET_BYTES:
        return kept
    _write_whole(path, fresh)
    return fresh


def _write_whole(path: Path, data: bytes) -> None:
    """Write a file so that it appears only when it is complete on the disk."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".writing-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
