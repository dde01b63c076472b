"""Observed paths and intended strokes in CSV."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from calibration.errors import InvalidData
from calibration.fields import STROKE_COLUMNS, Row, frame_of, row_of, stroke_of, text_of
from calibration.frames import Frame
from calibration.observed import IntendedStroke

COLUMNS: Final = ("shot", "t", "ball", "x", "y")


def from_csv(name: str, text: str) -> tuple[Frame, list[tuple[str, Row]], dict[str, IntendedStroke]]:
    """The frame, every sample with where it stands, and the strokes that are told beside them, by shot."""
    lines = text.splitlines()
    settings: dict[str, tuple[str, Any]] = {}
    begin = 0
    while begin < len(lines) and (lines[begin].lstrip().startswith("#") or not lines[begin].strip()):
        key, is_setting, value = lines[begin].lstrip("# \t").partition("=")
        if is_setting and key.strip() in settings:
            raise InvalidData(f"{name}, line {begin + 1}, {key.strip()}", value.strip(), "must stand once")
        if is_setting:
            settings[key.strip()] = f"{name}, line {begin + 1}", value.strip()
        begin += 1
    frame = frame_of(name, settings)
    return frame, list(_csv_rows(name, lines, begin)), {}


def _csv_rows(name: str, lines: list[str], begin: int) -> Iterator[tuple[str, Row]]:
    """Every row with where it stands."""
    if begin == len(lines):
        raise InvalidData(f"{name}, line {begin + 1}", "", f"must be the header {','.join(COLUMNS)}[,z]")
    header = [word.strip() for word in lines[begin].split(",")]
    if header not in ([*COLUMNS], [*COLUMNS, "z"]):
        raise InvalidData(f"{name}, line {begin + 1}", lines[begin], f"must be the header {','.join(COLUMNS)}[,z]")
    for number, line in enumerate(lines[begin + 1 :], begin + 2):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        where, words = f"{name}, line {number}", [word.strip() for word in line.split(",")]
        if len(words) != len(header):
            raise InvalidData(where, line, f"must have the {len(header)} columns {','.join(header)}")
        yield where, row_of(where, dict(zip(header, words, strict=True)))


def strokes_from_csv(file: Path, frame: Frame) -> dict[str, IntendedStroke]:
    """What the players meant, by shot."""
    reader = csv.reader(io.StringIO(text_of(file)))
    strokes: dict[str, IntendedStroke] = {}
    header: list[str] | None = None
    for words in reader:
        where, cells = f"{file.name}, line {reader.line_num}", [word.strip() for word in words]
        if not any(cells) or cells[0].startswith("#"):
            continue
        if header is None:
            header = cells
            if header[0] != "shot" or not set(header[1:]) <= set(STROKE_COLUMNS) or len(set(header)) < len(header):
                raise InvalidData(where, ",".join(words), f"must be the header shot,{','.join(STROKE_COLUMNS)}")
            continue
        if len(cells) != len(header):
            raise InvalidData(where, ",".join(words), f"must have the {len(header)} columns {','.join(header)}")
        if cells[0] in strokes:
            raise InvalidData(f"{where}, column shot", cells[0], "must stand once")
        strokes[cells[0]] = stroke_of(where, dict(zip(header[1:], cells[1:], strict=True)), frame)
    if header is None:
        raise InvalidData(f"{file.name}, line 1", "", f"must be the header shot,{','.join(STROKE_COLUMNS)}")
    return strokes
