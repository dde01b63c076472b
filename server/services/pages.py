"""Lists in pages: a cursor is the place after the last row given."""

from server.errors import invalid_field

PAGE = 50
LONGEST_PAGE = 200
LONGEST_NUMBER = 15
"""Digits."""


def cursor(text: str | None) -> int:
    """The row number a cursor stands for, 0 for none; raises `Invalid`."""
    return number("cursor", text, "the next_cursor of the page before, as it came")


def number(name: str, text: str | None, allowed: str) -> int:
    """A whole number from the address, 0 when it is not given; raises `Invalid`."""
    if text is None:
        return 0
    if not (text.isascii() and text.isdigit() and len(text) <= LONGEST_NUMBER):
        raise invalid_field(name, text, allowed)
    return int(text)


def limit(text: str | None) -> int:
    """How many rows to give, 50 unless told; raises `Invalid`."""
    if text is None:
        return PAGE
    if not (text.isascii() and text.isdigit() and len(text) <= 3 and 1 <= int(text) <= LONGEST_PAGE):
        raise invalid_field("limit", text, f"1 to {LONGEST_PAGE}")
    return int(text)
