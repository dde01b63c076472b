"""Lists in pages. A cursor names the last row given, so that rows that come or go meanwhile move no other."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import (
    BigInteger,
    CompoundSelect,
    Integer,
    Row,
    Select,
    String,
    Table,
    bindparam,
    select,
    tuple_,
    union_all,
)

from server.errors import invalid_field

PAGE = 50
LONGEST_PAGE = 200
LONGEST_NUMBER, LONGEST_TIME = 15, 19
"""Digits."""
LONGEST_ID = 64
SEARCH = r"[^\x00-\x1f\x7f]{1,64}"
ESCAPE = "/"
CURSOR_ALLOWED = "the next_cursor of the page before, as it came"


@dataclass(frozen=True, slots=True)
class PagePosition:
    """A row's place in a list: when it was made, and its id among those of the same time."""

    created_at: int
    id: str

    @classmethod
    def of(cls, row: Row[Any]) -> "PagePosition":
        """The place of a row."""
        return cls(row.created_at, row.id)

    def __str__(self) -> str:
        return f"{self.created_at}.{self.id}"


def place(text: str | None) -> PagePosition | None:
    """The place a cursor stands for, None for the start (no cursor, or 0); raises `Invalid`."""
    if text is None or text == "0":
        return None
    created_at, _, row_id = text.partition(".")
    if not (
        _is_number(created_at, LONGEST_TIME)
        and 1 <= len(row_id) <= LONGEST_ID
        and row_id.isascii()
        and row_id.isprintable()
    ):
        raise invalid_field("cursor", text, CURSOR_ALLOWED)
    return PagePosition(int(created_at), row_id)


def oldest_first(query: Select[Any], table: Table, *, is_first: bool) -> Select[Any]:
    """The query's rows in the order they were made, of the first page or those after a place (`values`)."""
    if not is_first:
        query = query.where(_key(table) > _AFTER)
    return query.order_by(table.c.created_at, table.c.id).limit(_ROWS)


def newest_first(query: Select[Any], table: Table, *, is_first: bool) -> Select[Any]:
    """The same, the newest first."""
    if not is_first:
        query = query.where(_key(table) < _AFTER)
    return query.order_by(table.c.created_at.desc(), table.c.id.desc()).limit(_ROWS)


def newest_of(queries: Sequence[Select[Any]], table: Table, *, is_first: bool) -> Select[Any] | CompoundSelect[Any]:
    """The same of the rows of several queries, no row in two of them: each is read from an index of its own, in order.

    One query with an OR would read and sort all its rows.
    """
    if len(queries) == 1:
        return newest_first(queries[0], table, is_first=is_first)
    pages = [newest_first(query, table, is_first=is_first).subquery() for query in queries]
    newest = union_all(*(select(page) for page in pages))
    order = (newest.selected_columns.created_at.desc(), newest.selected_columns.id.desc())
    return newest.order_by(*order).limit(_ROWS)


def values(after: PagePosition | None, limit: int) -> dict[str, Any]:
    """The parameters of such a page: one row more than it holds."""
    place = {} if after is None else {"after_at": after.created_at, "after_id": after.id}
    return {"rows": limit + 1, **place}


_AFTER: Final = tuple_(bindparam("after_at", type_=BigInteger), bindparam("after_id", type_=String))
_ROWS: Final[Any] = bindparam("rows", type_=Integer)


def cut(rows: Sequence[Row[Any]], limit: int) -> tuple[Sequence[Row[Any]], str | None]:
    """A page of the rows, and the cursor of the next one; None when there is nothing more."""
    return rows[:limit], str(PagePosition.of(rows[limit - 1])) if len(rows) > limit else None


def _key(table: Table) -> Any:
    return tuple_(table.c.created_at, table.c.id)


def cursor(text: str | None) -> int:
    """The number a cursor of a numbered list stands for, 0 for none; raises `Invalid`."""
    return number("cursor", text, CURSOR_ALLOWED)


def number(name: str, text: str | None, allowed: str) -> int:
    """A whole number from the address, 0 when it is not given; raises `Invalid`."""
    if text is None:
        return 0
    if not _is_number(text, LONGEST_NUMBER):
        raise invalid_field(name, text, allowed)
    return int(text)


def limit(text: str | None) -> int:
    """How many rows to give, 50 unless told; raises `Invalid`."""
    if text is None:
        return PAGE
    if not (text.isascii() and text.isdigit() and len(text) <= 3 and 1 <= int(text) <= LONGEST_PAGE):
        raise invalid_field("limit", text, f"1 to {LONGEST_PAGE}")
    return int(text)


def search(text: str | None) -> str | None:
    """What rows are to contain, None for anything; raises `Invalid`."""
    if text is not None and re.fullmatch(SEARCH, text) is None:
        raise invalid_field("search", text, "1 to 64 characters, no control characters")
    return text


def contains(column: Any) -> Any:
    """Whether the text of `part_of` is part of a column's, capitals or not."""
    return column.icontains(bindparam("part", type_=String), escape=ESCAPE)


def part_of(text: str) -> dict[str, Any]:
    """The parameter of `contains`; its `%` and `_` are nothing special."""
    return {"part": re.sub(f"[{ESCAPE}%_]", lambda found: ESCAPE + found[0], text)}


def _is_number(text: str, longest: int) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= longest and int(text) < 2**63
