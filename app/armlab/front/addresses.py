"""The addresses people can type."""

from __future__ import annotations

import contextlib
import ipaddress
import socket

LOCAL_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
_BOTH = (socket.AF_INET, socket.AF_INET6)
EVERYWHERE = {"0.0.0.0": (socket.AF_INET,), "::": _BOTH, "": _BOTH}
"""Hosts that stand for all addresses of this machine, with their address families."""
_FAR = {socket.AF_INET: "192.0.2.1", socket.AF_INET6: "2001:db8::1"}
"""Addresses of no machine, reserved for documentation."""


def addresses(host: str, port: int) -> tuple[str, list[str]]:
    """Return the address for this machine and the addresses for others in the room."""
    if host in EVERYWHERE:
        return _url("127.0.0.1", port), [_url(name, port) for name in own_addresses(*EVERYWHERE[host])]
    own = _url(host, port)
    return own, [] if host in LOCAL_NAMES else [own]


def served_names(host: str) -> frozenset[str]:
    """Return the host names by which a browser may address the lab."""
    if host in EVERYWHERE:
        return LOCAL_NAMES | {socket.gethostname().lower(), *own_addresses(*EVERYWHERE[host])}
    return LOCAL_NAMES | {host.lower()}


def own_addresses(*families: socket.AddressFamily) -> list[str]:
    """Return the addresses of this machine in its networks, the best first, one family after the other."""
    found = [name for family in families for name in _addresses_of(family)]
    return [name for name in dict.fromkeys(found) if _can_be_typed(ipaddress.ip_address(name))]


def _addresses_of(family: socket.AddressFamily) -> list[str]:
    found: list[str] = []
    with contextlib.suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
        # Connecting a datagram socket sends nothing; it only asks which address would be used for a far host.
        probe.connect((_FAR[family], 9))
        found.append(probe.getsockname()[0])
    with contextlib.suppress(OSError):
        found += [str(info[4][0]) for info in socket.getaddrinfo(socket.gethostname(), None, family)]
    return found


def _can_be_typed(address: ipaddress.IPv4Address | ipaddress.IPv6Address) -> bool:
    """Return whether others can reach this address: some IPv6 addresses are valid on one network link only."""
    bound_to_a_cable = address.version == 6 and address.is_link_local
    return not (address.is_loopback or address.is_unspecified or bound_to_a_cable)


def _url(host: str, port: int) -> str:
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"
