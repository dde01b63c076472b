"""Standard deviations of strokes in a TOML file: what ``pooliad calibrate`` writes and event files name."""

import tomllib
from pathlib import Path

from physics.errors import FieldError
from referee.play.noise import Sigmas


def read_sigmas(file: Path) -> Sigmas:
    """The standard deviations in a file; those left out are the Olympiad's.

    Raises:
        OSError: it cannot be read.
        FieldError: it is no TOML, or a field of it cannot be.
    """
    try:
        values = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise FieldError("sigmas", str(file), f"must be a TOML file of v, phi, theta, a and b: {error}") from None
    return Sigmas.from_dict(values)


def write_sigmas(file: Path, sigmas: Sigmas, notes: tuple[str, ...] = ()) -> None:
    """Write them; ``notes`` are put above as comments.

    Raises:
        OSError: the file cannot be written.
    """
    lines = [f"# {note}" for note in notes] + [f"{name} = {value!r}" for name, value in sigmas.to_dict().items()]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
