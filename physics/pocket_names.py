"""A pocket by its number or by its name."""

from operator import index
from typing import Final

from physics.constants import N_POCKETS, POCKET_NAMES
from physics.errors import FieldError

POCKET_NUMBERS: Final = {name: number for number, name in enumerate(POCKET_NAMES)}
"""``{"SW": 0, "W": 1, ...}``."""

POCKETS_ALLOWED: Final = f"0 to {N_POCKETS - 1}, or {', '.join(POCKET_NAMES)}"
"""What a pocket may be, in error messages."""


def pocket_number(pocket: int | str) -> int:
    """Return the number (0..5) of a pocket given by its number or its name (``"SW"``).

    Raises:
        FieldError: there is no such pocket.
    """
    number = POCKET_NUMBERS.get(pocket, -1) if isinstance(pocket, str) else index(pocket)
    if not 0 <= number < N_POCKETS:
        raise FieldError("pocket", pocket, f"must be {POCKETS_ALLOWED}")
    return number
