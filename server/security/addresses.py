"""Whose address it is: what requests without a token are counted by."""

import ipaddress
from typing import Final

UNKNOWN: Final = "unknown"
NETWORK_BITS: Final = 64
"""A host with IPv6 has a network of so many bits to itself (RFC 6177), and any address in it."""


def origin(host: str | None) -> str:
    """Who is behind an address: itself for IPv4, its /64 network for IPv6, `unknown` for what is no address."""
    try:
        address = ipaddress.ip_address(host or "")
    except ValueError:
        return UNKNOWN
    if isinstance(address, ipaddress.IPv4Address):
        return str(address)
    if address.ipv4_mapped is not None:
        return str(address.ipv4_mapped)
    return str(ipaddress.ip_network((int(address), NETWORK_BITS), strict=False))
