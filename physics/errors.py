"""Errors of the physics: every one names the field, the value that came and what is allowed.

::

    FieldError (ValueError)
    └── PhysicsError
        ├── InvalidTable    a table parameter
        ├── InvalidState    positions of the balls
        └── InvalidShot     parameters of a shot
"""

from typing import Any

LONGEST_SHOWN = 200
"""Characters of a value in a message: enough to recognise it by."""


def shown(value: Any) -> str:
    """A value as messages show it, what is long cut off."""
    text = repr(value)
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}..."


class FieldError(ValueError):
    """Bad input, of whatever package.

    Attributes:
        field: name of the offending part, e.g. ``"v"``, ``"positions[3]"`` or ``"call.pocket"``.
        value: what came.
        allowed: what is allowed, in words.
    """

    def __init__(self, field: str, value: Any, allowed: str) -> None:
        super().__init__(f"{field} = {shown(value)}: {allowed}")
        self.field = field
        self.value = value
        self.allowed = allowed

    def __reduce__(self) -> tuple[type, tuple[str, Any, str]]:
        """Pickle by the three arguments, so that the error crosses process borders."""
        return type(self), (self.field, self.value, self.allowed)


class PhysicsError(FieldError):
    """Bad input to the physics."""


class InvalidTable(PhysicsError):
    """A table parameter outside its range."""


class InvalidState(PhysicsError):
    """Ball positions that cannot be: not finite, overlapping, off the table."""


class InvalidShot(PhysicsError):
    """A shot parameter that is not a finite number in its range."""
