"""Observed paths and intended strokes from files, CSV or JSON: docs/calibration.md has both formats.

Whatever is wrong is told with file, line and column.
"""

from pathlib import Path

from calibration.assembling import assembled
from calibration.csv_files import from_csv, strokes_from_csv
from calibration.errors import InvalidData
from calibration.fields import text_of
from calibration.json_files import from_json
from calibration.observed import Observations
from physics import Table


def read_paths(file: Path, table: Table, strokes: Path | None = None) -> Observations:
    """The observed paths in a file, in the frame of the table they were seen on.

    Args:
        file: CSV, or JSON if its name ends in ``.json``.
        strokes: CSV of what the players meant: shot, v, phi, theta, a, b; an empty field is not known.

    Raises:
        OSError: a file cannot be read.
        InvalidData: something in one cannot be; the error names file, line and column.
    """
    text = text_of(file)
    read = from_json if file.suffix.lower() == ".json" else from_csv
    frame, rows, intended = read(file.name, text)
    if strokes is not None:
        intended = intended | strokes_from_csv(strokes, frame)
    observations = assembled(file.name, frame, rows, intended, table)
    unknown = set(intended) - {shot.name for shot in observations.shots}
    if unknown:
        raise InvalidData(f"{(strokes or file).name}, shot", min(unknown), "must be a shot of the paths")
    return observations
