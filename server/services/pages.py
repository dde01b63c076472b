"""Lists in pages: a cursor is the place after the last row given."""

from server.errors import invalid_field

PAGE = 50
LONGEST_PAGE = 200


def cursor(text: str | None) -> int:
    """The row number a cursor stands for, 0 for none; raises `Invalid`."""
    if text is None:
        return 0
    if not (text.isascii() and text.isdigit() and len(text) <= 15):
        raise invalid_field("cursor", text, "the next_cursor of the page before, as it came")
    return int(text)


def limit(text: str | None) -> int:
    """How many rows to give, 50 unless told; raises `Invalid`."""
    if text is None:
        return PAGE
    if not (text.isascii() and text.isdigit() and len(text) <= 3 and 1 <= int(text) <= LONGEST_PAGE):
        raise invalid_field("limit", text, f"1 to {LONGEST_PAGE}")
    return int(text)
