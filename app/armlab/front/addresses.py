"""The addresses people can type."""

from __future__ import annotations

import contextlib
import ipaddress
import socket
from collections.abc import Collection, Container

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


class AnyAddress:
    """Names, and every address in numbers: those of a machine change when it joins another network.

    Another site cannot make a browser call it by an address, as it can by a name of its own that points here.

    Parameters
    ----------
    names : collection of str
    """

    def __init__(self, names: Collection[str]) -> None:
        self._names = frozenset(names)

    def __contains__(self, name: object) -> bool:
        return name in self._names or _is_address(str(name))


def hosts_of(host: str, names: Collection[str] = ()) -> Container[str]:
    """Return what a browser may call the lab: by this machine, by its host, and by names that somebody has given it."""
    found = LOCAL_NAMES | {name.lower() for name in names}
    if host not in EVERYWHERE:
        return found | {host.lower()}
    machine = socket.gethostname().lower()
    return AnyAddress(found | {machine, f"{machine.removesuffix('.local')}.local"})


def network_of(address: str) -> str:
    """Return the network of an address: itself, or of IPv6 that of 64 bits, all of which one machine may have.

    Examples
    --------
    >>> network_of("192.168.1.5"), network_of("::ffff:192.168.1.5"), network_of("2001:db8::7"), network_of("")
    ('192.168.1.5', '192.168.1.5', '2001:db8::/64', '')
    """
    if ":" not in address:
        return address
    found = ipaddress.IPv6Address(address)
    return str(found.ipv4_mapped or ipaddress.ip_network((found.packed[:8] + bytes(8), 64)))


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


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _can_be_typed(address: ipaddress.IPv4Address | ipaddress.IPv6Address) -> bool:
    """Return whether others can reach this address: some IPv6 addresses are valid on one network link only."""
    bound_to_a_cable = address.version == 6 and address.is_link_local
    return not (address.is_loopback or address.is_unspecified or bound_to_a_cable)


def _url(host: str, port: int) -> str:
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"
