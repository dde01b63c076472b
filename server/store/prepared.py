"""Statements that every stroke sends, put together once.

SQLite answers a statement in microseconds, in this process: to hand it through the library takes ten times as long. So
there it goes to the driver itself, in the library's words and types. PostgreSQL is another process, often on another
machine: there the library sends it.
"""

import sqlite3
from collections import namedtuple
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from typing import Any, Final

from sqlalchemy import ColumnElement, Connection, Executable, Select, SelectBase, bindparam
from sqlalchemy.engine import Dialect
from sqlalchemy.types import TypeEngine

from server.store import sqlite

Parameters = Mapping[str, Any]
Values = Sequence[Any]
Convert = Callable[[Any], Any]

MOST_IDS: Final = 256
"""In one statement."""


class Prepared:
    """A statement and its parameters' names, which are always the same.

    Args:
        statement: of the library; no list among its parameters.
    """

    def __init__(self, statement: Executable) -> None:
        self._statement = statement
        self._sent: _Sent | None = None

    def first(self, connection: Connection, **parameters: Any) -> Any:
        """The first row, its columns as attributes; None when there is none."""
        if not is_direct(connection):
            return connection.execute(self._statement, parameters).first()
        sent = self._put_together(connection.dialect, parameters)
        cursor = sent.carried_out(connection, parameters)
        values = cursor.fetchone()
        cursor.close()  # else the snapshot is held for as long as nobody has read all
        return None if values is None else sent.row(values)

    def all(self, connection: Connection, **parameters: Any) -> list[Any]:
        """All rows, their columns as attributes."""
        if not is_direct(connection):
            return list(connection.execute(self._statement, parameters))
        sent = self._put_together(connection.dialect, parameters)
        return [sent.row(values) for values in sent.carried_out(connection, parameters).fetchall()]

    def run(self, connection: Connection, parameters: Parameters) -> int:
        """Change rows: how many were."""
        if not is_direct(connection):
            return connection.execute(self._statement, parameters).rowcount
        return int(self._put_together(connection.dialect, parameters).carried_out(connection, parameters).rowcount)

    def _put_together(self, dialect: Dialect, parameters: Parameters) -> "_Sent":
        if self._sent is None:
            self._sent = _Sent(self._statement, dialect, parameters)
        return self._sent


class PreparedForIds:
    """The same for rows that are found by their ids: for a power of two of them, the last repeated to make up for it.

    Args:
        statement: of the library; no list among its parameters. column: has the ids.
    """

    def __init__(self, statement: Select[Any], column: ColumnElement[Any]) -> None:
        self._statement = statement
        self._column = column
        self._of_size: dict[int, Prepared] = {}

    def all(self, connection: Connection, ids: Iterable[str]) -> list[Any]:
        """All rows with these ids, `MOST_IDS` of them at a time."""
        wanted, found = list(ids), []
        for start in range(0, len(wanted), MOST_IDS):
            part = wanted[start : start + MOST_IDS]
            size = 1 << (len(part) - 1).bit_length()
            names = _names(size)
            values = dict(zip(names, part + part[-1:] * (size - len(part)), strict=True))
            found += self._for(size).all(connection, **values)
        return found

    def _for(self, size: int) -> Prepared:
        if size not in self._of_size:
            ids: list[Any] = [bindparam(name) for name in _names(size)]
            self._of_size[size] = Prepared(self._statement.where(self._column.in_(ids)))
        return self._of_size[size]


@cache
def _names(size: int) -> tuple[str, ...]:
    """The parameters' names."""
    return tuple(f"id_{number}" for number in range(size))


def is_direct(connection: Connection) -> bool:
    """Whether statements go to the driver itself."""
    return connection.dialect.name == "sqlite"


class _Sent:
    """A statement as the driver gets it."""

    def __init__(self, statement: Any, dialect: Dialect, parameters: Parameters) -> None:
        compiled = statement.compile(dialect=dialect, column_keys=list(parameters))
        self._text: Final = str(compiled)
        names: Sequence[str] = compiled.positiontup or ()
        types = (compiled.binds[name].type for name in names)
        self._parameters: Final = tuple(
            (name, compiled.params.get(name), _bound(kind, dialect)) for name, kind in zip(names, types, strict=True)
        )
        columns = statement.selected_columns if isinstance(statement, SelectBase) else ()
        self._columns: Final = tuple(_read(column.type, dialect) for column in columns)
        self._are_as_they_come: Final = not any(self._columns)
        self._row = _row_of([str(column.key) for column in columns])

    def carried_out(self, connection: Connection, parameters: Parameters) -> sqlite3.Cursor:
        """The driver's cursor."""
        values = [
            parameters.get(name, default) if convert is None else convert(parameters.get(name, default))
            for name, default, convert in self._parameters
        ]
        return sqlite.execute(connection, self._text, values)

    def row(self, values: Values) -> Any:
        """A row as the library would give it."""
        if self._are_as_they_come:
            return self._row._make(values)
        return self._row._make(
            value if convert is None else convert(value) for value, convert in zip(values, self._columns, strict=True)
        )


def _row_of(names: list[str]) -> Any:
    return namedtuple("Row", names)


def _bound(kind: TypeEngine[Any], dialect: Dialect) -> Convert | None:
    """What the library makes of a parameter; None: nothing."""
    return kind.dialect_impl(dialect).bind_processor(dialect)


def _read(kind: TypeEngine[Any], dialect: Dialect) -> Convert | None:
    """What the library makes of a value of a row; None: nothing."""
    return kind.dialect_impl(dialect).result_processor(dialect, None)
