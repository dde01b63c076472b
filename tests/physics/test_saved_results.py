"""Results in files and as columns."""

import dataclasses
import json
import math

import numpy as np
import pytest

from physics import Result, Shot, Table, rack, resume, simulate

BREAK = Shot(9.0, 268.5, 4.0, 1.0, 3.0)


@pytest.fixture(params=["olympiad", "nine_foot", "nine_foot that flies"])
def result(request):
    name, *flies = request.param.split(" that ")
    table = Table.named(name).replace(mu_slide=0.21)
    if flies:
        table = table.replace(flight=True)
    return simulate(table, rack(table, seed=2), BREAK)


@pytest.mark.parametrize("ending", [".npz", ".result", ""])
def test_a_saved_result_is_the_same_to_the_bit(result, tmp_path, ending):
    file = tmp_path / f"break{ending}"
    result.save(file)
    loaded = Result.load(file)
    assert [path.name for path in tmp_path.iterdir()] == [file.name]
    assert (loaded.table, loaded.final, loaded.n_events) == (result.table, result.final, result.n_events)
    assert repr(loaded.facts) == repr(result.facts)
    assert list(loaded.events) == list(result.events)
    time = 0.4 * result.duration
    assert loaded.at(time).positions.tobytes() == result.at(time).positions.tobytes()


def test_so_is_one_that_was_resumed_and_one_without_events(result, tmp_path):
    going_on = resume(result.table, result.at(0.5))
    going_on.save(tmp_path / "on")
    loaded = Result.load(tmp_path / "on")
    assert loaded.final == going_on.final
    for field in dataclasses.fields(loaded.start):
        assert np.array_equal(getattr(loaded.start, field.name), getattr(going_on.start, field.name), equal_nan=True)
    bare = simulate(result.table, result.final, Shot(1.0, 90.0, 30.0), trace=False)
    bare.save(tmp_path / "bare")
    assert Result.load(tmp_path / "bare").final == bare.final
    with pytest.raises(ValueError, match="no trace"):
        _ = Result.load(tmp_path / "bare").events


def spoil(arrays, name, value):
    return {key: array for key, array in (arrays | {name: value}).items() if array is not None}


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("facts", None, "facts"),
        ("final", np.zeros((1, 31)), "final = float64 of shape"),
        ("trace", np.zeros((3, 7)), "trace = float64 of shape"),
        ("start", np.array([[object()] * 32]), "Object arrays cannot be loaded"),
        ("table", np.array("{}"), "must be one of"),
        ("table", np.array("[1"), "Expecting"),
    ],
)
def test_a_file_that_is_no_result_is_refused(result, tmp_path, name, value, words):
    result.save(tmp_path / "good")
    with np.load(tmp_path / "good") as saved:
        arrays = spoil(dict(saved), name, value)
    with (tmp_path / "bad").open("wb") as out:
        np.savez(out, **arrays)
    with pytest.raises(ValueError, match="must be what Result") as caught:
        Result.load(tmp_path / "bad")
    assert words in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"no archive", b"PK\x03\x04 cut"])
def test_any_other_file_too(tmp_path, content):
    (tmp_path / "other").write_bytes(content)
    with pytest.raises(ValueError, match="must be what Result"):
        Result.load(tmp_path / "other")
    with pytest.raises(OSError, match="No such file"):
        Result.load(tmp_path / "missing")


def test_columns_say_what_the_events_say(result):
    columns = result.events.to_arrays()
    assert {len(column) for column in columns.values()} == {result.n_events}
    for place, event in enumerate(result.events):
        row = {name: column[place] for name, column in columns.items()}
        assert (row["time"], row["kind"], row["ball"], row["other"]) == (
            event.time,
            event.kind,
            event.ball,
            event.other,
        )
        for prefix, state in zip(("", "other_"), event.states, strict=False):
            told = tuple(row[prefix + name] for name in ("x", "y", "vx", "vy", "wx", "wy", "wz", "motion"))
            assert told == (*state.position, *state.velocity, *state.spin, state.motion.name.lower())
            if result.table.flies:
                assert (row[prefix + "height"], row[prefix + "velocity_z"]) == (state.height, state.velocity_z)
        if len(event.states) == 1:
            assert math.isnan(row["other_x"])
            assert row["other_motion"] == ""


class Frame:
    """Takes what both `pandas.DataFrame` and `polars.DataFrame` take: names to arrays of one dimension and length."""

    def __init__(self, data):
        assert isinstance(data, dict)
        self.columns = list(data)
        self.height = len(next(iter(data.values())))
        for name, column in data.items():
            assert isinstance(name, str)
            assert isinstance(column, np.ndarray)
            assert column.shape == (self.height,)
            assert column.dtype.kind in "ifU", (name, column.dtype)


def test_columns_make_a_data_frame_of_either_library(result):
    frame = Frame(result.events.to_arrays())
    assert frame.height == result.n_events
    assert frame.columns[:6] == ["time", "kind", "ball", "other", "x", "y"]


def test_a_dictionary_is_json(result):
    value = json.loads(json.dumps(result.to_dict(), allow_nan=False))
    assert value["status"] == "at_rest"
    assert len(value["events"]) == value["n_events"] == result.n_events
    assert value["final"] == result.final.to_dict()
    assert Table.from_dict(value["table"]) == result.table
