"""Everything the network sees: pages, tokens, limits, and the WebSockets of the labs."""

import os

CERTIFICATES = "SSL_CERT_FILE"
"""Variable that names the file of certificates a process trusts."""


def _import_aiohttp() -> None:
    """Import aiohttp, and keep it from reading the certificates of the whole world meanwhile.

    It does so for connections that the front never makes, and takes a quarter of the time until the page is served.
    """
    before = os.environ.get(CERTIFICATES)
    os.environ[CERTIFICATES] = os.devnull
    try:
        import aiohttp  # noqa: F401
    finally:
        del os.environ[CERTIFICATES]
        if before is not None:
            os.environ[CERTIFICATES] = before


_import_aiohttp()
