"""A code that everybody in the room knows and a stranger does not: with it the lab may be open to a network."""

from __future__ import annotations

import hashlib
import hmac
import time
from collections.abc import Callable

from armlab.front.addresses import network_of
from armlab.session.saved_up import SavedUpEach

TRIES, TRIES_A_SECOND = 10.0, 0.2
"""Number of wrong codes from one address that are allowed in a row, and the rate afterwards: one in five seconds."""

OF_ONE_NETWORK = 10.0
"""Factor by which more are allowed from all addresses of one network: a class may share it."""

LONGEST = 100
"""Longest code, in characters."""

FORM = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Armlab</title>
<style>
:root {{ color-scheme: light dark }}
body {{ font: 16px system-ui, sans-serif; max-width: 22em; margin: 20vh auto; padding: 0 1em; color: #1f2733 }}
input, button {{ font: inherit; padding: .4em .7em }} input {{ width: 11em; margin-bottom: .6em }}
p {{ line-height: 1.5 }}
@media (prefers-color-scheme: dark) {{ body {{ background: #161a20; color: #e6e9ee }} }}
</style>
<h1>Armlab</h1>
<p>{said}</p>
<form>{kept}
<input name="code" aria-label="Room code" autofocus autocomplete="off" maxlength="100"> <button>Enter the lab</button>
</form>
"""
HIDDEN = '<input type="hidden" name="{}" value="{}">'
"""Field of the form that takes along what the address has besides the code, by name and value."""

POLICY = "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; base-uri 'none'; frame-ancestors 'self'"

ASKED = "This lab asks for the room code. Your teacher knows it."
WRONG = "That is not the room code. Try again."
TOO_OFTEN = "Too many wrong codes came from this address. Wait a little."


class Room:
    """The code of the room, the browsers let in by it, and wrong attempts.

    Parameters
    ----------
    code : str
        Capital letters do not matter.
    secret : bytes
        Signs what browsers are let in by.
    clock : callable
    """

    def __init__(self, code: str, secret: bytes, clock: Callable[[], float] = time.monotonic) -> None:
        self._code = _plain(code)
        self._guessed = SavedUpEach(TRIES_A_SECOND, TRIES, clock=clock)
        self._guessed_there = SavedUpEach(OF_ONE_NETWORK * TRIES_A_SECOND, OF_ONE_NETWORK * TRIES, clock=clock)
        self.cookie = f"armlab-room-{hashlib.sha256(secret).hexdigest()[:8]}"
        self.key = hmac.new(secret, b"room " + self._code, hashlib.sha256).hexdigest()
        """Value of the cookie of everybody inside; it changes with the code."""

    def is_in(self, key: str | None) -> bool:
        """Return whether the cookie belongs to somebody who has given the code."""
        return hmac.compare_digest((key or "").encode(), self.key.encode())

    def refusal(self, said: str | None, address: str) -> str:
        """Return the reason why a browser with this code, or none, is not let in; empty when it is."""
        if said is None:
            return ASKED
        network = network_of(address)
        if self._guessed.wait(address) > 0.0 or self._guessed_there.wait(network) > 0.0:
            return TOO_OFTEN
        if hmac.compare_digest(_plain(said[:LONGEST]), self._code):
            return ""
        self._guessed.note(address)
        if network != address:
            self._guessed_there.note(network)
        return WRONG


def _plain(word: str) -> bytes:
    return " ".join(word.split()).casefold().encode()
