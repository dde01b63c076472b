"""What objects show of themselves at a prompt: a line, and one that says something."""

import pytest

import client
import physics
from physics import Shot, Table

CHANGED = Table.nine_foot().replace(corner_mouth=0.12, e_cushion=0.9)


@pytest.mark.parametrize("table", [Table.olympiad(), Table.fastfiz(), Table.nine_foot(), CHANGED])
def test_a_table_is_written_as_it_is_made(table):
    assert eval(repr(table), {"Table": Table}) == table
    assert len(repr(table)) < 100


def test_results_are_told_in_a_line():
    state = physics.TableState.from_positions({0: (0.5, 1.5), 3: (0.5, 1.0)})
    played = Shot(2.0, 270.0, 10.0)
    result = physics.simulate(Table.olympiad(), state, played)
    assert repr(result.events).startswith(f"Events({result.n_events}: 0.000000 s  ball 0  cue strike ... ")
    facts = repr(result.facts)
    assert f"first_contact={{3: {result.facts.first_contact[3]}}}" in facts
    assert "pocketed" not in facts
    assert repr(physics.Facts.none()) == "Facts()"
    batch = physics.simulate_batch(Table.olympiad(), state, [played, Shot(99.0, 0.0), Shot(2.0, 90.0, 10.0)])
    assert repr(batch) == "Batch(3 shots, 2 AT_REST, 1 OUT_OF_RANGE)"


def test_strokes_are_told_in_a_line():
    strokes = client.play("random", "random", games=1, seed=1).games[0].strokes
    assert all(len(repr(stroke)) < 250 for stroke in strokes)
    struck = next(stroke for stroke in strokes if stroke.shot is not None)
    assert repr(struck) == f"<Stroke {struck.index} of seat {struck.seat}: {struck.shot}, {struck.result!r}>"
