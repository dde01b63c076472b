"""The parts of `search` that find better strokes: banks aimed, finalists polished, jumps."""

import math
from statistics import NormalDist

import numpy as np
import pytest

import physics
from client.agents.search import banks, polish
from client.agents.search.breaks import worth_of_breaking
from client.agents.search.budget import Budget, Pace
from client.agents.search.draws import independent_normals, spread_normals
from client.agents.search.evaluate import Evaluator, Responder, answered
from client.agents.search.finalists import Finalists
from client.agents.search.jumps import ELEVATIONS, leaps
from client.agents.search.odds import Odds, odds, safety_odds
from client.agents.search.options import Options
from client.agents.search.refine import falls
from client.agents.search.shots import Shots, Tables
from client.agents.search.sight import Sight, Valuation
from client.agents.search.sweep import sweep
from client.agents.search.value import Values
from referee.rules.batch_rulings import target_balls

OLYMPIAD, NINE = physics.Table.olympiad(), physics.Table.nine_foot()


def at(table, balls, noise=1.0):
    """An evaluator, what answers it, and the table alone, solids to shoot."""
    values = Values(Sight(table, noise), noise)
    evaluator = Evaluator(table, values, noise, np.random.default_rng(5), Budget(Pace()), False)
    positions = np.full((1, 16, 2), np.nan)
    for ball, place in balls.items():
        positions[0, ball] = place
    return evaluator, Responder(table, values, physics.simulate_batch), Tables(positions, np.zeros(1, np.int8))


BEHIND = {0: (0.25, 0.4), 1: (0.56, 1.0), 9: (0.4, 0.68), 10: (0.7, 0.8), 11: (0.3, 1.2), 8: (0.9, 2.0)}


def test_aimed_banks_are_pocketed_more_often_than_those_come_upon():
    """Under the noise, over the best of both: the middle of the directions that do it, at more speeds."""
    evaluator, responder, tables = at(OLYMPIAD, BEHIND)
    swept = answered(sweep(evaluator, tables, 21, False), responder)
    worth = answered(evaluator.as_meant(swept), responder)
    better = answered(banks.aimed(evaluator, swept, worth, 12), responder)
    assert len(better) > 12
    assert (better.margin >= 0.0).all()
    assert falls(better, answered(evaluator.simulated(better), responder)).mean() > 0.9

    def best_share(shots):
        spread = shots[np.repeat(np.arange(len(shots)), 60)]
        noise = np.random.default_rng(1).normal(size=(len(spread), 5)) * (0.075, 0.125, 0.1, 0.5, 0.5)
        strokes = spread.strokes + noise
        batch = physics.simulate_batch(OLYMPIAD, spread.before(), np.maximum(strokes, (0, -999, 0, -99, -99)))
        return np.sort(falls(spread, batch).reshape(len(shots), 60).mean(axis=1))[-5:].mean()

    assert best_share(better) > best_share(swept[np.flatnonzero(swept.ball >= 0)]) + 0.05


@pytest.mark.parametrize("table", [OLYMPIAD, NINE], ids=["olympiad", "nine_foot"])
def test_neighbours_can_be_played(table):
    evaluator, _, tables = at(table, BEHIND)
    parents = Shots(
        tables, np.zeros(3, np.int64),
        np.array([[0.06, 60.0, 5.0, 17.0, 5.0], [table.v_max, 359.9, 5.0, 0.0, 0.0], [3.0, 61.0, 5.0, -3.0, -17.0]]),
        np.array([1, 1, -1]), np.array([4, 4, -1]), np.array([0.0, 0.3, 50.0]),
    )  # fmt: skip
    near = polish.neighbours(evaluator, evaluator.values.sight.raised(parents), 1.0, np.random.default_rng(2))
    v, phi, theta, a, b = near.strokes.T
    assert len(near) > 12
    assert ((v > 0.0) & (v <= table.v_max) & (phi >= 0.0) & (phi < 360.0) & (theta >= 0.0)).all()
    assert (np.hypot(a, b) <= polish.FURTHEST + 1e-9).all()
    state = physics.TableState.from_positions(BEHIND)
    assert all(physics.check(table, state, physics.Shot(*row)) is None for row in near.strokes.tolist())


def test_a_neighbour_of_a_jump_is_a_jump():
    evaluator, _, tables = at(NINE, {0: (0.6, 0.6), 9: (0.6, 0.95), 1: (0.6, 1.6), 8: (1.0, 2.2)})
    jumps = leaps(evaluator, tables, target_balls(tables.positions, tables.group)[0])
    assert len(jumps) > 20
    assert jumps.strokes[:, 2].min() >= min(ELEVATIONS) - 1e-9
    near = polish.neighbours(evaluator, jumps[:3], 0.5, np.random.default_rng(2))
    assert len(near) > 12
    assert near.strokes[:, 2].min() > 20.0


def test_nothing_hidden_nothing_jumped():
    evaluator, _, tables = at(NINE, {0: (0.6, 0.6), 9: (0.2, 0.95), 1: (0.6, 1.6), 8: (1.0, 2.2)})
    assert not len(leaps(evaluator, tables, target_balls(tables.positions, tables.group)[0]))


def test_polish_finds_a_better_stroke():
    """From a pot that is aimed badly and far too hard, by 400 copies that had no part in the choice."""
    evaluator, responder, tables = at(
        OLYMPIAD, {0: (0.5, 0.9), 1: (0.3, 0.5), 2: (0.8, 1.7), 9: (0.9, 0.4), 8: (0.2, 1.8)}
    )
    pots = evaluator.values.sight.pots(tables, 1)
    bad = np.array([[4.5, pots.phi[0, 0] + 0.6 * pots.margin[0, 0], 0.0, 6.0, 0.0]])
    shots = evaluator.values.sight.raised(
        Shots(tables, np.zeros(1, np.int64), bad, pots.ball[0], pots.pocket[0], pots.margin[0])
    )
    first = found = Finalists.of(shots, answered(evaluator.noisy(shots, 100), responder))
    for spread, copies in polish.rounds(6000):
        found = answered(polish.better(evaluator, found, spread, copies, np.random.default_rng(3)), responder).best(8)
    both = first.shots.joined(found.best(1).shots)
    before, after = answered(evaluator.noisy(both, 400), responder).mean(axis=1)
    assert after > before + 0.05


def test_rounds_spend_no_more_than_they_are_given():
    for shots in (0, 431, 432, 5_000, 10**9):
        given = list(polish.rounds(shots))
        assert sum(polish.PARENTS * (polish.CHILDREN + 1) * copies for _, copies in given) <= shots
        assert all(copies <= polish.MOST_COPIES for _, copies in given)
    assert len(given) == polish.ROUNDS
    assert math.prod(spread for spread, _ in given) < 1e-6


@pytest.mark.parametrize("noise", [0.0, 0.5, 1.0, 2.0, 3.7, 5.0])
@pytest.mark.parametrize("table", [OLYMPIAD, NINE], ids=["olympiad", "nine_foot"])
def test_what_games_bear_out_keeps_the_order_of_chances(table, noise):
    """Else a better table could count for less; and certainties stay chances."""
    race = np.linspace(0.0, 1.0, 101)
    borne_out = odds(noise, table.has_jaws).of(race)
    assert (np.diff(borne_out[1:-1]) > 0.0).all()
    assert (np.diff(borne_out) >= 0.0).all()
    assert ((borne_out > 0.0) & (borne_out < 1.0)).all()


def test_a_table_is_worth_what_games_bear_out():
    """To its shooter and to the opponent alike; a stroke that decides the game is certain all the same."""
    evaluator, responder, tables = at(OLYMPIAD, BEHIND, noise=5.0)
    values, nowhere = evaluator.values, np.zeros(1, bool)
    race = values.raced(tables, tables.positions, nowhere, Valuation())
    assert values.to_shoot(tables.positions, tables.group, nowhere) == pytest.approx(odds(5.0, False).of(race))
    assert abs(odds(5.0, False).of(race)[0] - race[0]) > 0.01
    nothing = physics.Shot(0.2, 270.0, 0.6)  # the cue ball touches nothing: a foul
    missed = Shots(tables, np.zeros(1, np.int64), np.array([[nothing.v, nothing.phi, nothing.theta, 0.0, 0.0]]),
                   np.array([-1]), np.array([-1]), np.zeros(1))  # fmt: skip
    worth = answered(evaluator.as_meant(missed), responder)
    assert 0.0 < worth[0] < 0.5
    _, responder, alone = at(OLYMPIAD, {0: (0.3, 0.3), 8: (0.1, 0.1)}, noise=5.0)
    pots = values.sight.pots(alone, 1)
    strokes = np.array([[1.5, pots.phi[0, 0], 0.0, 0.0, 0.0]])
    made = values.sight.raised(Shots(alone, np.zeros(1, np.int64), strokes, pots.ball[0], pots.pocket[0], np.zeros(1)))
    assert answered(evaluator.as_meant(made), responder)[0] == 1.0


@pytest.mark.parametrize("table", [OLYMPIAD, NINE], ids=["olympiad", "nine_foot"])
def test_a_new_rack_is_worth_less_the_more_is_missed(table):
    """Between measured levels too; who breaks is hardly ahead where every other ball is missed."""
    worths = [worth_of_breaking(table, noise) for noise in (0.0, 1.0, 1.5, 2.0, 3.5, 5.0)]
    assert all(0.4 < worth < 0.75 for worth in worths)
    if not table.has_jaws:
        assert worths == sorted(worths, reverse=True)


@pytest.mark.parametrize("count", [1, 2, 6, 17, 400])
def test_every_component_falls_once_into_each_of_so_many_likely_intervals(count):
    """Latin hypercube sampling (McKay, Beckman & Conover, Technometrics 21, 1979)."""
    draws = spread_normals(np.random.default_rng(3), count)
    probability = np.vectorize(NormalDist().cdf)(draws)
    assert draws.shape == (count, 5)
    assert np.abs(np.sort(probability, axis=0) - (np.arange(count)[:, None] + 0.5) / count).max() <= 0.5 / count + 1e-3


def test_spread_draws_are_normal_each_and_their_means_scatter_less():
    """Of a threshold in two components, as a pot is one: unbiased, with less than half the variance."""
    chance, chances = np.random.default_rng(4), {}
    for draw in (spread_normals, independent_normals):
        sets = np.array([draw(chance, 16) for _ in range(2000)])
        made = (np.abs(sets[:, :, 1] + 0.3 * sets[:, :, 3]) < 1.0).mean(axis=1)
        chances[draw] = made
        assert np.abs(sets.mean(axis=(0, 1))).max() < 0.03
        assert np.abs(sets.std(axis=(0, 1)) - 1.0).max() < 0.03
    truth = 2.0 * NormalDist().cdf(1.0 / 1.09**0.5) - 1.0
    assert abs(chances[spread_normals].mean() - truth) < 0.01
    assert chances[spread_normals].var() < 0.5 * chances[independent_normals].var()


def test_a_safety_counts_less_than_the_model_says_and_a_pot_as_much():
    """At noise 1 on a table without jaws; elsewhere nothing was measured, and nothing is changed."""
    assert safety_odds(1.0, False).of(np.array([0.59]))[0] < 0.3
    assert safety_odds(5.0, False) == safety_odds(1.0, True) == Odds(0.0, 1.0)
    evaluator, responder, tables = at(OLYMPIAD, {0: (0.5, 1.0), 3: (0.2, 0.5), 8: (0.9, 2.0), 12: (0.9, 0.3)})
    plain = Evaluator(
        OLYMPIAD, evaluator.values, 1.0, np.random.default_rng(5), Budget(Pace()), False, Options(safety_odds=False)
    )
    strokes = np.array([[1.5, 240.0, 3.0, 0.0, 0.0]] * 2)
    shots = Shots(tables, np.zeros(2, np.int64), strokes, np.array([3, -1]), np.array([0, -1]), np.zeros(2))
    pot, safety = answered(evaluator.as_meant(shots), responder)
    same, before = answered(plain.as_meant(shots), responder)
    assert pot == same
    assert safety == pytest.approx(safety_odds(1.0, False).of(np.array([before]))[0])
    assert safety < before
