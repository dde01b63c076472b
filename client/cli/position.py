"""The position a command is told to begin from, in a file."""

from pathlib import Path
from typing import TYPE_CHECKING

from client.cli.output import USAGE, fail

if TYPE_CHECKING:
    from referee import Game


def read_position(file: Path) -> "Game":
    """The position in a file. The command ends if the file holds none."""
    from pydantic import ValidationError

    from protocol import Position

    try:
        return Position.model_validate_json(file.read_bytes()).to_game()
    except OSError as error:
        fail(f"{file} cannot be read: {error}", USAGE)
    except (ValidationError, ValueError) as error:
        fail(f"{file} is no position: {error}", USAGE)
