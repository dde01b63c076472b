"""Observed paths from files: the formats of docs/calibration.md, and what is said about those that are not."""

import dataclasses
import json
from typing import Any

import numpy as np
import pytest

from calibration import InvalidData, read_paths
from calibration.synthetic import seen
from calibration.writing import paths_csv, strokes_csv
from physics import Table

TABLE = Table.olympiad()
SETTINGS = "# length = mm\n# time = s\n# frame = corner\n"
ROWS = "shot,t,ball,x,y\n" + "".join(f"1,{0.1 * n:.1f},0,{500 + 10 * n},1500\n" for n in range(6))


def read(tmp_path, text, name="paths.csv"):
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    return read_paths(file, TABLE)


def test_what_is_written_is_read(tmp_path):
    observations = seen(TABLE, 3, np.random.default_rng(1))
    (tmp_path / "paths.csv").write_text(paths_csv(observations, ("synthetic",)))
    (tmp_path / "strokes.csv").write_text(strokes_csv(observations))
    again = read_paths(tmp_path / "paths.csv", TABLE, tmp_path / "strokes.csv")
    assert (again.sigma, again.strike_known) == (observations.sigma, True)
    for one, other in zip(observations.shots, again.shots, strict=True):
        assert one.name == other.name
        np.testing.assert_array_equal(one.balls, other.balls)
        np.testing.assert_allclose(one.places, other.places, atol=6e-6)
        meant, read_back = dataclasses.astuple(one.stroke), dataclasses.astuple(other.stroke)
        assert read_back == pytest.approx(meant, rel=1e-5)


def test_json_says_the_same_as_csv(tmp_path):
    data: dict[str, Any] = {"length": "mm", "time": "s", "frame": "corner"}
    samples = [[0.1 * n, 0, 500 + 10 * n, 1500] for n in range(6)]
    data["shots"] = [{"shot": "1", "samples": samples, "stroke": {"v": 2, "phi": 0}}]
    from_json = read(tmp_path, json.dumps(data), "paths.json").shots[0]
    from_csv = read(tmp_path, SETTINGS + ROWS).shots[0]
    np.testing.assert_allclose(from_json.places, from_csv.places)
    assert (from_json.stroke.v, from_json.stroke.a) == (2.0, None)


def test_a_frame_along_the_table_is_turned_and_not_mirrored(tmp_path):
    """x along the length, y to its left: a quarter turn about the middle of the table."""
    text = "# length = m\n# time = 10 Hz\n# frame = centre lengthwise\nshot,t,ball,x,y\n"
    text += "".join(f"1,{n},0,{0.1 * n},0.2\n" for n in range(4))
    shot = read(tmp_path, text).shots[0]
    np.testing.assert_allclose(shot.times, [0.0, 0.1, 0.2, 0.3])
    np.testing.assert_allclose(shot.places[3], [0.5 * TABLE.width - 0.2, 0.5 * TABLE.length + 0.3])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ROWS, "paths.csv, length = None: must be one of m, cm, mm, in"),
        (SETTINGS.replace("= s", "= h") + ROWS, "paths.csv, line 2, time = 'h': must be one of s, ms, or a rate"),
        (SETTINGS + "# glare = much\n" + ROWS, "paths.csv, line 4, glare = 'much': is no setting"),
        (SETTINGS + ROWS.replace("520", "52o"), "paths.csv, line 7, column x = '52o': must be a number"),
        (SETTINGS + ROWS.replace("520", "nan"), "paths.csv, line 7, column x = 'nan': must be a number"),
        (SETTINGS + ROWS.replace(",0,530", ",16,530"), "paths.csv, line 8, column ball = '16': must be a ball"),
        (SETTINGS + ROWS.replace("520,", ""), "paths.csv, line 7 = '1,0.2,0,1500': must have the 5 columns"),
        (SETTINGS + ROWS + "1,0.2,0,1,1\n", "column t = 0.2: must differ: ball 0 was seen at this time"),
        (SETTINGS + "x,y\n", "paths.csv, line 4 = 'x,y': must be the header shot,t,ball,x,y[,z]"),
        (SETTINGS, "paths.csv, line 4 = '': must be the header"),
        (SETTINGS.replace("mm", "m") + ROWS, "100 % of the places lie off it; see unit and frame"),
        (
            SETTINGS + "".join(ROWS.splitlines(keepends=True)[:3]),
            "shot 1 = 2: must have at least 4 samples of the cue ball",
        ),
        (SETTINGS + "# length = m\n" + ROWS, "paths.csv, line 4, length = 'm': must stand once"),
        (SETTINGS + ROWS + "1,-1e9,0,500,1500\n", "shot 1 = '1e+09 s': must last at most 300 s"),
        (SETTINGS + "# sigma = -1\n" + ROWS, "line 4, sigma = '-1': must be from 0.01 to 100 mm"),
    ],
)
def test_bad_data_get_a_sentence_with_line_and_column(tmp_path, text, words):
    with pytest.raises(InvalidData) as refused:
        read(tmp_path, text)
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"length": "mm", "length": "m", "shots": []}', "paths.json, length = 'm': must stand once"),
        (
            '{"length": "mm", "time": "s", "frame": "corner", "shots": ['
            + ", ".join(['{"shot": 1, "samples": []}'] * 2)
            + "]}",
            "paths.json, shots[1].shot = 1: must stand once",
        ),
    ],
)
def test_nothing_in_json_is_said_twice(tmp_path, text, words):
    """The last one would win, and the first be lost without a word."""
    with pytest.raises(InvalidData) as refused:
        read(tmp_path, text, "paths.json")
    assert words in str(refused.value)


def test_broken_json_is_told_by_line_and_column(tmp_path):
    with pytest.raises(InvalidData, match="line 2, column 1"):
        read(tmp_path, '{"length": "mm",\n]', "paths.json")


def test_a_stroke_of_no_shot_is_refused(tmp_path):
    (tmp_path / "paths.csv").write_text(SETTINGS + ROWS)
    (tmp_path / "strokes.csv").write_text("shot,v,phi\n1,2,90\n7,2,90\n")
    with pytest.raises(InvalidData, match=r"strokes\.csv, shot = '7': must be a shot of the paths"):
        read_paths(tmp_path / "paths.csv", TABLE, tmp_path / "strokes.csv")
