"""What a program that is no browser asks of a lab."""

from __future__ import annotations

import urllib.error
import urllib.request

import viser
import websockets
from websockets.asyncio.client import connect

from support.patience import WAIT


def get(url, headers=None, follow=True):
    class Stay(urllib.request.HTTPRedirectHandler):
        def redirect_request(self, *_args):
            return None

    opener = urllib.request.build_opener() if follow else urllib.request.build_opener(Stay)
    request = urllib.request.Request(url, headers=headers or {})
    try:
        with opener.open(request) as response:
            return response.status, response.headers, response.read()
    except urllib.error.HTTPError as error:
        return error.code, error.headers, error.read()


async def opened(url, headers, protocol=None):
    """Try to open a socket; return the HTTP status of the refusal, or 101."""
    protocol = protocol or f"viser-v{viser.__version__}"
    try:
        socket_ = await connect(
            url.replace("http", "ws", 1),
            subprotocols=[websockets.Subprotocol(protocol)],
            additional_headers=headers,
            open_timeout=WAIT,
        )
    except websockets.InvalidStatus as refusal:
        return refusal.response.status_code
    await socket_.close()
    return 101
