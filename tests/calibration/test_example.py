"""The shipped example: labelled as synthetic, and its intervals hold the parameters that its head tells."""

import re

import pytest
from support.require import ROOT

from calibration import calibrate, read_paths
from physics import Table

FOLDER = ROOT / "examples" / "calibration"
HEAD = (FOLDER / "paths.csv").read_text().partition("# length")[0]
TRUTH = {name: float(value) for name, value in re.findall(r"(\w+) (0\.\d+)[, ]", HEAD.partition("seen with")[0])}


@pytest.fixture(scope="module")
def found():
    table = Table.nine_foot()
    observations = read_paths(FOLDER / "paths.csv", table, FOLDER / "strokes.csv")
    return calibrate(table, observations, tuple(TRUTH))


def test_it_says_that_it_is_synthetic():
    assert HEAD.startswith("# Synthetic: ")
    assert list(TRUTH) == ["mu_slide", "mu_roll", "e_ball", "e_cushion", "mu_cushion"]


def test_its_intervals_hold_its_hidden_truth(found):
    assert found.is_trusted
    assert [shot.why for shot in found.unexplained] == []
    for one in found.estimates:
        assert one.low <= TRUTH[one.name] <= one.high, one
        assert one.sigma < 0.005 * max(0.1, TRUTH[one.name])


def test_its_false_detection_is_left_out(found):
    """The only one of its samples that lies anywhere on the table."""
    assert sum(shot.outliers for shot in found.shots) == 1
