"""The table a command is told to use: by name, JSON with parameters, or a TOML file with them."""

from typing import TYPE_CHECKING, Any

from typer.core import TyperCommand

from client.cli.output import USAGE, fail

if TYPE_CHECKING:
    from physics import Table

NAMES = "TABLES"
"""In the help of an option of a `TableCommand`: stands for the names of all tables."""


class TableCommand(TyperCommand):
    """A command whose help lists the tables there are. The physics is imported when the help is shown, not before."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """The help, with the names of the tables in place of ``NAMES``."""
        from physics.table import NAMED

        for parameter in self.params:
            text = getattr(parameter, "help", None)
            if text:
                parameter.help = text.replace(NAMES, ", ".join(NAMED))  # type: ignore[attr-defined]
        super().format_help(ctx, formatter)


def load_table(text: str) -> "Table":
    """Read a table from its name, from JSON or from a TOML file. The command ends if that is not a table."""
    import json
    from pathlib import Path

    from physics import InvalidTable, Table
    from physics.table_file import ENDING, read_table

    try:
        if text.endswith(ENDING):
            return read_table(Path(text))
        return Table.from_dict(json.loads(text) if text.lstrip().startswith("{") else {"name": text})
    except (json.JSONDecodeError, RecursionError) as error:
        fail(f"--table is not JSON: {error}", USAGE)
    except OSError as error:
        fail(f"{text} cannot be read: {error.strerror}", USAGE)
    except InvalidTable as error:
        fail(str(error), USAGE)
