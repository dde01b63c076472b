"""What the fields of a file say: samples, strokes, settings. An error names file, line and column."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from calibration.errors import InvalidData
from calibration.frames import FRAMES, LENGTHS, STRIKES, TIMES, Frame, seconds_of
from calibration.observed import ROUGH_SIGMA, IntendedStroke
from physics.constants import N_BALLS

STROKE_COLUMNS: Final = ("v", "phi", "theta", "a", "b")
SETTINGS: Final = ("length", "time", "frame", "sigma", "strike")

Row = tuple[str, float, int, float, float, float]
"""Shot, t, ball, x, y, z as written; NaN without z."""


def text_of(file: Path) -> str:
    """The text of a file; InvalidData if it is not UTF-8."""
    try:
        return file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InvalidData(f"{file.name}, byte {error.start}", error.reason, "must be UTF-8 text") from None


def row_of(where: str, words: Mapping[str, Any]) -> Row:
    """One sample from the words of its columns; z may be left out."""
    shot = str(words["shot"]).strip()
    if not shot or len(shot) > 64 or not shot.isprintable():
        raise InvalidData(f"{where}, column shot", words["shot"], "must be a name of 1 to 64 letters")
    ball = number_of(where, "ball", words["ball"])
    if ball not in range(N_BALLS):
        raise InvalidData(f"{where}, column ball", words["ball"], f"must be a ball from 0 to {N_BALLS - 1}")
    t, x, y = (number_of(where, column, words[column]) for column in ("t", "x", "y"))
    z = words.get("z", "")
    return shot, t, int(ball), x, y, math.nan if z in ("", None) else number_of(where, "z", z)


def number_of(where: str, column: str, value: Any) -> float:
    """A finite number; text is read."""
    try:
        found = math.nan if isinstance(value, bool) or not isinstance(value, str | int | float) else float(value)
    except (ValueError, OverflowError):
        found = math.nan
    if not math.isfinite(found) or abs(found) > 1e12:
        raise InvalidData(f"{where}, column {column}", value, "must be a number")
    return found


def frame_of(name: str, settings: Mapping[str, tuple[str, Any]]) -> Frame:
    """What the numbers mean; ``settings`` have where each was written, and its value."""
    for key, (where, value) in settings.items():
        if key not in SETTINGS:
            raise InvalidData(f"{where}, {key}", value, f"is no setting; these are: {', '.join(SETTINGS)}")
    where, length = settings.get("length", (name, None))
    if length not in LENGTHS:
        raise InvalidData(f"{where}, length", length, f"must be one of {', '.join(LENGTHS)}")
    where, time = settings.get("time", (name, None))
    seconds = seconds_of(time) if isinstance(time, str) else None
    if seconds is None:
        raise InvalidData(f"{where}, time", time, f"must be one of {', '.join(TIMES)}, or a rate such as 240 Hz")
    where, frame = settings.get("frame", (name, None))
    if frame not in FRAMES:
        raise InvalidData(f"{where}, frame", frame, f"must be one of {', '.join(FRAMES)}")
    where, strike = settings.get("strike", (name, "known"))
    if strike not in STRIKES:
        raise InvalidData(f"{where}, strike", strike, f"must be one of {', '.join(STRIKES)}")
    where, written = settings.get("sigma", (name, None))
    sigma = None if written in (None, "") else LENGTHS[length] * number_of(where, "sigma", written)
    if sigma is not None and not ROUGH_SIGMA <= sigma <= 0.1:
        raise InvalidData(f"{where}, sigma", written, "must be from 0.01 to 100 mm")
    return Frame(LENGTHS[length], seconds, frame, sigma, strike == "known")


def stroke_of(where: str, values: Any, frame: Frame) -> IntendedStroke:
    """A stroke in the table's frame; an empty field is not known."""
    if not isinstance(values, Mapping) or not set(values) <= set(STROKE_COLUMNS):
        raise InvalidData(where, values, f"must be an object with some of {', '.join(STROKE_COLUMNS)}")
    known = {key: number_of(where, key, value) for key, value in values.items() if value not in ("", None)}
    if "phi" in known:
        known["phi"] += frame.turn
    for key, least, most in (("v", 0.0, 20.0), ("theta", 0.0, 89.0), ("a", -29.0, 29.0), ("b", -29.0, 29.0)):
        if key in known and not least <= known[key] <= most:
            raise InvalidData(f"{where}, column {key}", known[key], f"must be a number from {least:g} to {most:g}")
    return IntendedStroke(**known)
