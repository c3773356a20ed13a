"""Signed tokens: which browser is which, chosen by us and not by the browser."""

from __future__ import annotations

import hashlib
import hmac
import os
import secrets
from pathlib import Path


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
        """Return the token of a cookie value, or None when it was not made here."""
        token, _, _ = (value or "").rpartition(".")
        if not token or not hmac.compare_digest(self._signed(token).encode(), (value or "").encode()):
            return None
        return token

    def _signed(self, token: str) -> str:
        return f"{token}.{hmac.new(self._secret, token.encode(), hashlib.sha256).hexdigest()[:32]}"


def kept_secret(folder: Path | None) -> bytes:
    """Return the secret of a folder, made on first use and readable by its owner only; without a folder a new one."""
    if folder is None:
        return secrets.token_bytes(32)
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    path = folder / "secret"
    try:
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        return path.read_bytes()
    with os.fdopen(handle, "wb") as file:
        secret = secrets.token_bytes(32)
        file.write(secret)
    return secret
