"""The addresses people can type."""

from __future__ import annotations

import contextlib
import socket

LOCAL_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
EVERYWHERE = ("0.0.0.0", "::", "")


def addresses(host: str, port: int) -> tuple[str, list[str]]:
    """Return the address for this machine and those for others in the room."""
    if host in EVERYWHERE:
        return _url("127.0.0.1", port), [_url(name, port) for name in own_addresses()]
    own = _url(host, port)
    return own, [] if host in LOCAL_NAMES else [own]


def served_names(host: str) -> frozenset[str]:
    """Return the host names a browser may address the lab by."""
    if host in EVERYWHERE:
        return LOCAL_NAMES | {socket.gethostname().lower(), *own_addresses()}
    return LOCAL_NAMES | {host.lower()}


def own_addresses() -> list[str]:
    """Return the addresses of this machine in its networks, best first."""
    found: list[str] = []
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        # Connecting a datagram socket sends nothing; it only asks which address would be used for a far host.
        probe.connect(("192.0.2.1", 9))
        found.append(probe.getsockname()[0])
    with contextlib.suppress(OSError):
        found += [info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)]
    return [name for name in dict.fromkeys(map(str, found)) if not name.startswith("127.") and name != "0.0.0.0"]


def _url(host: str, port: int) -> str:
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"
