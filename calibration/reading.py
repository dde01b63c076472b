"""Observed paths and intended strokes from files, CSV or JSON: docs/calibration.md has both formats.

Whatever is wrong is told with file, line and column.
"""

import csv
import io
import json
import math
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from calibration.errors import InvalidData
from calibration.frames import FRAMES, LENGTHS, STRIKES, TIMES, Frame, seconds_of
from calibration.observed import ROUGH_SIGMA, IntendedStroke, Observations, ObservedShot, share_off
from physics import Table
from physics.constants import N_BALLS

COLUMNS: Final = ("shot", "t", "ball", "x", "y")
STROKE_COLUMNS: Final = ("v", "phi", "theta", "a", "b")
SETTINGS: Final = ("length", "time", "frame", "sigma", "strike")
LEAST_SAMPLES = 4
"""Samples of the cue ball in a shot."""
LONGEST_SHOT = 300.0
"""s. No shot lasts a minute; more is a wrong unit, or two shots of one name."""
MOST_OFF = 0.2
"""Part of the samples that may lie off the table; more are a wrong unit or frame."""

Row = tuple[str, float, int, float, float, float]
"""Shot, t, ball, x, y, z as written; NaN without z."""


def read_paths(file: Path, table: Table, strokes: Path | None = None) -> Observations:
    """The observed paths in a file, in the frame of the table they were seen on.

    Args:
        file: CSV, or JSON if its name ends in ``.json``.
        strokes: CSV of what the players meant: shot, v, phi, theta, a, b; an empty field is not known.

    Raises:
        OSError: a file cannot be read.
        InvalidData: something in one cannot be; the error names file, line and column.
    """
    text = _text(file)
    read = _from_json if file.suffix.lower() == ".json" else _from_csv
    frame, rows, intended = read(file.name, text)
    if strokes is not None:
        intended = intended | _read_strokes(strokes, frame)
    observations = _assembled(file.name, frame, rows, intended, table)
    unknown = set(intended) - {shot.name for shot in observations.shots}
    if unknown:
        raise InvalidData(f"{(strokes or file).name}, shot", min(unknown), "must be a shot of the paths")
    return observations


def _text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InvalidData(f"{file.name}, byte {error.start}", error.reason, "must be UTF-8 text") from None


def _from_csv(name: str, text: str) -> tuple[Frame, list[tuple[str, Row]], dict[str, IntendedStroke]]:
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
    frame = _frame(name, settings)
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
        yield where, _row(where, dict(zip(header, words, strict=True)))


def _row(where: str, words: Mapping[str, Any]) -> Row:
    shot = str(words["shot"]).strip()
    if not shot or len(shot) > 64 or not shot.isprintable():
        raise InvalidData(f"{where}, column shot", words["shot"], "must be a name of 1 to 64 letters")
    ball = _number(where, "ball", words["ball"])
    if ball not in range(N_BALLS):
        raise InvalidData(f"{where}, column ball", words["ball"], f"must be a ball from 0 to {N_BALLS - 1}")
    t, x, y = (_number(where, column, words[column]) for column in ("t", "x", "y"))
    z = words.get("z", "")
    return shot, t, int(ball), x, y, math.nan if z in ("", None) else _number(where, "z", z)


def _number(where: str, column: str, value: Any) -> float:
    """A finite number; text is read."""
    try:
        found = math.nan if isinstance(value, bool) or not isinstance(value, str | int | float) else float(value)
    except (ValueError, OverflowError):
        found = math.nan
    if not math.isfinite(found) or abs(found) > 1e12:
        raise InvalidData(f"{where}, column {column}", value, "must be a number")
    return found


def _frame(name: str, settings: Mapping[str, tuple[str, Any]]) -> Frame:
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
    sigma = None if written in (None, "") else LENGTHS[length] * _number(where, "sigma", written)
    if sigma is not None and not ROUGH_SIGMA <= sigma <= 0.1:
        raise InvalidData(f"{where}, sigma", written, "must be from 0.01 to 100 mm")
    return Frame(LENGTHS[length], seconds, frame, sigma, strike == "known")


def _from_json(name: str, text: str) -> tuple[Frame, list[tuple[str, Row]], dict[str, IntendedStroke]]:
    try:
        data = json.loads(text, object_pairs_hook=partial(_once, name))
    except json.JSONDecodeError as error:
        raise InvalidData(f"{name}, line {error.lineno}, column {error.colno}", error.msg, "must be JSON") from None
    except RecursionError:
        raise InvalidData(name, "nested too deep", "must be JSON of an object with shots") from None
    if not isinstance(data, dict) or not isinstance(data.get("shots"), list):
        raise InvalidData(name, data, "must be an object with settings and a list of shots")
    frame = _frame(name, {key: (name, value) for key, value in data.items() if key != "shots"})
    rows: list[tuple[str, Row]] = []
    intended, names = {}, set()
    for place, shot in enumerate(data["shots"]):
        where = f"{name}, shots[{place}]"
        if not isinstance(shot, dict) or not isinstance(shot.get("samples"), list):
            raise InvalidData(where, shot, "must be an object with shot and samples, perhaps stroke")
        if _named(shot)["shot"] in names:
            raise InvalidData(f"{where}.shot", shot["shot"], "must stand once")
        names.add(_named(shot)["shot"])
        for number, sample in enumerate(shot["samples"]):
            at = f"{where}.samples[{number}]"
            if not isinstance(sample, list) or len(sample) not in (4, 5):
                raise InvalidData(at, sample, "must be [t, ball, x, y] or [t, ball, x, y, z]")
            rows.append((at, _row(at, dict(zip(("t", "ball", "x", "y", "z"), sample, strict=False)) | _named(shot))))
        if shot.get("stroke") is not None:
            intended[_named(shot)["shot"]] = _stroke(f"{where}.stroke", shot["stroke"], frame)
    return frame, rows, intended


def _once(name: str, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object of JSON, whose members must stand once."""
    members: dict[str, Any] = {}
    for key, value in pairs:
        if key in members:
            raise InvalidData(f"{name}, {key}", value, "must stand once")
        members[key] = value
    return members


def _named(shot: Mapping[str, Any]) -> dict[str, str]:
    return {"shot": str(shot.get("shot", "")).strip()}


def _stroke(where: str, values: Any, frame: Frame) -> IntendedStroke:
    """A stroke in the table's frame; an empty field is not known."""
    if not isinstance(values, Mapping) or not set(values) <= set(STROKE_COLUMNS):
        raise InvalidData(where, values, f"must be an object with some of {', '.join(STROKE_COLUMNS)}")
    known = {key: _number(where, key, value) for key, value in values.items() if value not in ("", None)}
    if "phi" in known:
        known["phi"] += frame.turn
    for key, least, most in (("v", 0.0, 20.0), ("theta", 0.0, 89.0), ("a", -29.0, 29.0), ("b", -29.0, 29.0)):
        if key in known and not least <= known[key] <= most:
            raise InvalidData(f"{where}, column {key}", known[key], f"must be a number from {least:g} to {most:g}")
    return IntendedStroke(**known)


def _read_strokes(file: Path, frame: Frame) -> dict[str, IntendedStroke]:
    reader = csv.reader(io.StringIO(_text(file)))
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
        strokes[cells[0]] = _stroke(where, dict(zip(header[1:], cells[1:], strict=True)), frame)
    if header is None:
        raise InvalidData(f"{file.name}, line 1", "", f"must be the header shot,{','.join(STROKE_COLUMNS)}")
    return strokes


def _assembled(
    name: str, frame: Frame, rows: list[tuple[str, Row]], intended: Mapping[str, IntendedStroke], table: Table
) -> Observations:
    """The shots in the order of their first samples."""
    by_shot: dict[str, dict[tuple[float, int], tuple[float, float, float]]] = {}
    for where, (shot, t, ball, x, y, z) in rows:
        samples = by_shot.setdefault(shot, {})
        if (t, ball) in samples:
            raise InvalidData(f"{where}, column t", t, f"must differ: ball {ball} was seen at this time already")
        samples[t, ball] = x, y, z
    if not by_shot:
        raise InvalidData(name, "no samples", "must have at least one shot")
    shots = tuple(
        _shot(name, shot, samples, frame, table, intended.get(shot, IntendedStroke()))
        for shot, samples in by_shot.items()
    )
    off = share_off(table, shots)
    if off > MOST_OFF:
        allowed = f"must fit the table {table.name}: {100.0 * off:.0f} % of the places lie off it; see unit and frame"
        raise InvalidData(f"{name}, x and y", "unit or frame", allowed)
    return Observations(shots, frame.sigma, frame.strike_known)


def _shot(
    name: str,
    shot: str,
    samples: Mapping[tuple[float, int], tuple[float, float, float]],
    frame: Frame,
    table: Table,
    stroke: IntendedStroke,
) -> ObservedShot:
    keys = sorted(samples)
    places = np.array([samples[key] for key in keys])
    times = frame.time * np.array([t for t, _ in keys])
    balls = np.array([ball for _, ball in keys])
    seen = int((balls == 0).sum())
    if seen < LEAST_SAMPLES:
        raise InvalidData(f"{name}, shot {shot}", seen, f"must have at least {LEAST_SAMPLES} samples of the cue ball")
    if (lasts := float(times[-1] - times[0])) > LONGEST_SHOT:
        allowed = f"must last at most {LONGEST_SHOT:g} s from its first sample to its last; see the unit of time"
        raise InvalidData(f"{name}, shot {shot}", f"{lasts:g} s", allowed)
    heights = frame.length * places[:, 2]
    return ObservedShot(shot, times, balls, frame.places(table, places[:, :2]), heights, stroke)
