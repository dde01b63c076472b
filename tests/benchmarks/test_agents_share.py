"""A bounded share of `pooliad bench agents`."""

import pytest

from benchmarks import agents


@pytest.mark.slow
def test_a_match_against_random_is_accounted_for():
    row = agents.against_random("random", 2, seed=4)
    assert row["won"] + row["lost"] == 2
    assert 0.0 <= row["won_share_low_95"] <= row["won"] / 2 <= row["won_share_high_95"] <= 1.0
    assert row["strokes"] >= row["balls_called"] > 0
    assert 0.0 < row["median_s"] <= row["p95_s"] < 10.0
