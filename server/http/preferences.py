"""What a request would rather have (RFC 7240, the header `Prefer`)."""

from collections.abc import Iterable
from typing import Final

MINIMAL: Final = "return=minimal"
APPLIED: Final = "preference-applied"
"""The header that says which preference was heeded."""


def wants_minimal(fields: Iterable[str]) -> bool:
    """Whether the answer need not repeat what the request did: `return=minimal`.

    Of a preference that comes twice the first counts; what cannot be read, and everything else, is ignored (RFC 7240,
    section 2).

    Args:
        fields: the values of all `Prefer` header fields, in order.
    """
    for preference in ",".join(fields).split(","):
        name, _, value = preference.partition(";")[0].partition("=")
        if name.strip().lower() == "return":
            return value.strip().strip('"').lower() == "minimal"
    return False
