"""A table is found again from paths that a camera would have seen on it; what the model cannot explain is named.

The method is that of docs/calibration.md; the truth is what the paths were simulated with.
"""

import dataclasses

import numpy as np
import pytest

from calibration import InvalidFit, Observations, calibrate, error_model
from calibration.observed import estimated_noise
from calibration.outliers import outliers
from calibration.synthetic import Camera, Player, seen
from physics import Shot, Table, TableState, simulate

TRUTH = {"mu_slide": 0.21, "mu_roll": 0.0125, "e_ball": 0.94, "mu_ball": 0.06, "cushion_perpendicular": 0.68}
TABLE = Table.olympiad().replace(**TRUTH)


@pytest.fixture(scope="module")
def observations():
    return seen(TABLE, 5, np.random.default_rng(11), Camera(missing=0.1, outliers=0.01))


@pytest.fixture(scope="module")
def found(observations):
    return calibrate(Table.olympiad(), observations, tuple(TRUTH))


def test_parameters_come_back_within_their_errors(found):
    """Five standard errors: a right fit misses once in 350,000 times, a wrong one by dozens."""
    assert found.is_trusted
    assert [shot.why for shot in found.unexplained] == []
    for one in found.estimates:
        assert abs(one.value - TRUTH[one.name]) < 5.0 * one.sigma, one
        assert one.sigma < 0.03 * max(0.1, TRUTH[one.name])
        assert one.is_determined


def test_the_fitted_table_foretells_shots_it_has_not_seen(found):
    """Strokes and starts known exactly: within 1 cm after a second, nearer than the table before.

    One of eight may graze a ball that the fitted table lets it miss, or the other way round.
    """
    exact, nobody_errs = Camera(sigma=0.0, span=1.0), Player(0.0, 0.0, 0.0, 0.0, 0.0)
    shots = seen(TABLE, 8, np.random.default_rng(5), exact, nobody_errs).shots
    fitted, before = ([foretold(table, shot) for shot in shots] for table in (found.table, Table.olympiad()))
    assert sorted(fitted)[-2] < 0.01
    assert sorted(before)[0] > np.median(fitted)
    assert all(now < then for now, then in zip(fitted, before, strict=True))


def foretold(table, shot):
    """The farthest that any ball is from where it was seen, m."""
    places = {ball: shot.places[k] for k, ball in enumerate(shot.balls.tolist()) if shot.times[k] == 0.0}
    result = simulate(table, TableState.from_positions(places), Shot(*dataclasses.astuple(shot.stroke)))
    paths, _ = result.paths(np.minimum(shot.times, result.duration))
    off = paths[np.arange(len(shot.times)), shot.balls] - shot.places
    return float(np.hypot(*off.T).max())


def test_covariance_and_bootstrap_are_of_one_size(found):
    for one in found.estimates:
        low, high = one.bootstrap
        assert 0.2 < (high - low) / (one.high - one.low) < 5.0


def test_a_parameter_that_the_data_say_nothing_of_is_said_to_be_so(observations):
    found = calibrate(TABLE, observations, ["mu_roll", "rack_gap"])
    roll, gap = found.estimates
    assert roll.is_determined
    assert not gap.is_determined


def test_a_shot_of_another_world_is_named(observations):
    """In the middle of a shot the cue ball is carried off by a hand."""
    first = observations.shots[0]
    late = (first.times > 0.5 * first.times.max()) & (first.balls == 0)
    carried = dataclasses.replace(first, places=first.places + 0.25 * late[:, None] * (first.times[:, None] - 0.5))
    found = calibrate(TABLE, Observations((carried, *observations.shots[1:]), 1e-3), ["mu_slide", "mu_roll"])
    assert [shot.name for shot in found.unexplained] == [first.name]
    assert "ball 0 parts from the model" in found.unexplained[0].why
    for one in found.estimates:
        assert abs(one.value - TRUTH[one.name]) < 6.0 * one.sigma


@pytest.mark.slow
def test_a_wrong_law_is_said_so(observations):
    """Balls that lose no speed when they meet cannot explain balls that do."""
    wrong = TABLE.replace(e_ball=1.0)
    found = calibrate(wrong, observations, ["mu_roll"])
    assert not found.is_trusted
    assert found.misfit > 2.0


def test_noise_is_read_from_the_scatter_of_paths():
    shots = seen(TABLE, 6, np.random.default_rng(2), Camera(sigma=2e-3, rate=60.0)).shots
    assert estimated_noise(shots) == pytest.approx(2e-3, rel=0.15)


def test_a_false_detection_is_an_outlier_and_a_collision_is_none():
    shot = seen(TABLE, 1, np.random.default_rng(3), Camera(rate=60.0)).shots[0]
    assert not outliers(shot, 1e-3).any()
    places = shot.places.copy()
    places[len(places) // 2] += 0.2
    marked = outliers(dataclasses.replace(shot, places=places), 1e-3)
    assert np.flatnonzero(marked).tolist() == [len(places) // 2]


def test_good_samples_between_collisions_are_taken_back():
    """Seen: left out for good, as strays of a wrong order of events were; intervals missed by 20 standard errors."""
    clean = seen(TABLE, 3, np.random.default_rng(48), Camera())
    assert sum(int(outliers(shot, 1e-3).sum()) for shot in clean.shots) == 3
    assert [shot.outliers for shot in calibrate(TABLE, clean, ["mu_slide"]).shots] == [0, 0, 0]


def test_the_time_of_the_strike_need_not_be_known():
    """Of balls that were seen at rest before it."""
    shots = seen(TABLE, 3, np.random.default_rng(11)).shots
    shots = tuple(dataclasses.replace(shot, times=shot.times + 0.013) for shot in shots)
    found = calibrate(TABLE, Observations(shots, 1e-3, strike_known=False), ["mu_slide"])
    assert [round(shot.strike, 3) for shot in found.shots] == pytest.approx([0.013] * 3, abs=0.004)


@pytest.mark.parametrize(
    ("fit", "words"),
    [
        ([], "fit = ''"),
        (["mu_glide"], "fit = 'mu_glide': must be different ones of"),
        (["mu_roll", "mu_roll"], "fit = 'mu_roll'"),
        (["cue_test"], "fit = 'cue_test'"),
    ],
)
def test_what_cannot_be_fitted_is_refused(observations, fit, words):
    with pytest.raises(InvalidFit, match=words.replace("(", r"\(")):
        calibrate(TABLE, observations, fit)


@pytest.mark.slow
def test_the_errors_of_a_player_come_back():
    """Speed and azimuth of 16 strokes: within the sampling error of a standard deviation, 18 % of it, three times."""
    observations = seen(TABLE, 16, np.random.default_rng(4), player=Player(v=0.08, phi=0.3, a=1.5, b=1.0))
    found = calibrate(TABLE, observations, ["mu_roll"])
    errors = error_model(observations.shots, found.shots)
    assert errors.told["v"]
    assert errors.told["phi"]
    assert errors.sigmas["phi"] == pytest.approx(0.3, rel=0.55)
    assert errors.sigmas["v"] == pytest.approx(0.08, rel=0.55)
