"""A bounded share of `pooliad bench chained`: every final position is a legal start, and JSON keeps its bits."""

import numpy as np
import pytest

import physics
from benchmarks import chained


@pytest.mark.parametrize("seed", range(3))
def test_no_start_is_refused_and_json_keeps_every_bit(seed):
    tally = chained.chain(400, seed)
    assert not tally.failures, tally.failures[0]
    assert (tally.shots, tally.refused, tally.changed, tally.unended) == (400, 0, 0, 0)
    assert tally.longest > 5, "shots were chained, not only played from racks"


def test_a_refused_start_is_counted():
    """The judge itself: a ball beside the table is no legal start."""
    tally = chained.Tally()
    outside = physics.TableState.from_positions({0: (0.5, 0.5), 1: (-0.5, 0.5), 2: (0.5, 0.9)})
    assert chained.follow(outside, np.random.default_rng(1), tally) is None
    assert (tally.refused, tally.failures[0]["fault"]) == (1, "refused")


def test_a_changed_bit_is_counted(monkeypatch):
    """The judge itself: one ulp in one coordinate on the way through JSON is seen."""
    through = chained.through_json

    def shifted(state):
        x, y = state.position(state.balls[-1])
        return through(state).moved(state.balls[-1], (float(np.nextafter(x, 0.5)), y))

    monkeypatch.setattr(chained, "through_json", shifted)
    tally = chained.chain(1, 0)
    assert (tally.shots, tally.changed) == (1, 1)
