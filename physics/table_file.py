"""A table in a TOML file: the name of the one it started from, and the parameters that differ."""

import tomllib
from pathlib import Path

from physics.errors import InvalidTable
from physics.table import Table

ENDING = ".toml"


def read_table(file: Path) -> Table:
    """The table in a file.

    Raises:
        OSError: it cannot be read.
        InvalidTable: it is no TOML, or no table.
    """
    try:
        values = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InvalidTable(
            "table", str(file), f"must be a TOML file of a table's name and parameters: {error}"
        ) from None
    return Table.from_dict(values)


def write_table(file: Path, table: Table, notes: tuple[str, ...] = ()) -> None:
    """Write a table; ``notes`` are put above it as comments.

    Raises:
        OSError: the file cannot be written.
    """
    named = Table.named(table.name).to_dict()
    changed = {key: value for key, value in table.to_dict().items() if value != named[key]}
    lines = [f"# {note}" for note in notes]
    lines += [f"{key} = {_toml(value)}" for key, value in ({"name": table.name} | changed).items()]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _toml(value: str | bool | float) -> str:
    """A value as TOML has it: the shortest text that gives the same number back."""
    if isinstance(value, str):
        return f'"{value}"'
    return str(value).lower() if isinstance(value, bool) else repr(float(value))
