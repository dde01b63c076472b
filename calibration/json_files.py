"""Observed paths and intended strokes in one JSON object."""

import json
from collections.abc import Mapping
from functools import partial
from typing import Any

from calibration.errors import InvalidData
from calibration.fields import Row, frame_of, row_of, stroke_of
from calibration.frames import Frame
from calibration.observed import IntendedStroke


def from_json(name: str, text: str) -> tuple[Frame, list[tuple[str, Row]], dict[str, IntendedStroke]]:
    """The frame, every sample with where it stands, and the strokes that are told beside them, by shot."""
    try:
        data = json.loads(text, object_pairs_hook=partial(_once, name))
    except json.JSONDecodeError as error:
        raise InvalidData(f"{name}, line {error.lineno}, column {error.colno}", error.msg, "must be JSON") from None
    except RecursionError:
        raise InvalidData(name, "nested too deep", "must be JSON of an object with shots") from None
    if not isinstance(data, dict) or not isinstance(data.get("shots"), list):
        raise InvalidData(name, data, "must be an object with settings and a list of shots")
    frame = frame_of(name, {key: (name, value) for key, value in data.items() if key != "shots"})
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
            rows.append((at, row_of(at, dict(zip(("t", "ball", "x", "y", "z"), sample, strict=False)) | _named(shot))))
        if shot.get("stroke") is not None:
            intended[_named(shot)["shot"]] = stroke_of(f"{where}.stroke", shot["stroke"], frame)
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
