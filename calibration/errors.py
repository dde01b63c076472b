"""Errors of calibration: every one names the field, the value that came and what is allowed."""

from physics.errors import FieldError


class InvalidData(FieldError):
    """Observed paths or strokes that cannot be read; the field begins with file, line and column."""


class InvalidFit(FieldError):
    """A fit that cannot be: an unknown parameter, too few shots, a law the table does not have."""
