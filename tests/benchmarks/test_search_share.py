"""A bounded share of the measurements of `search`: pairs, their pooling, the studies behind its constants."""

import numpy as np
import pytest

from benchmarks import recording, search, search_breaks, search_habits, search_odds
from client.agents.search.breaks import Break, worth_of_breaking
from client.agents.search.odds import Odds
from physics import Table
from referee import Decision, EightBall, Game, Phase, RuleId, Ruling
from tournament.statistics import score_of_cells


@pytest.mark.slow
def test_a_pair_is_two_games_on_the_same_racks():
    row = search.play_pair(("search:shots=300", "random"), 1.0, "olympiad", 3)
    mine, theirs = row["of_player"], row["of_opponent"]
    assert mine["points"] + theirs["points"] == 2.0
    assert (mine["breaks"], theirs["breaks"]) == (1, 1)
    assert mine["strokes"] >= mine["called"] >= mine["made"] >= 0
    assert mine["simulated"] > 0
    again = search.play_pair(("search:shots=300", "random"), 1.0, "olympiad", 3)
    assert {**again["of_player"], "seconds": 0} == {**mine, "seconds": 0}


def test_pieces_are_pooled_by_match_up():
    row = match_of([2.0, 2.0, 1.0, 2.0])
    assert row["score"] == 0.875
    assert (row["pairs"], row["fouls"], row["seconds_per_stroke"]) == (4, {"R32": 4}, 0.5)
    assert row["elo"] == pytest.approx(338.0, abs=0.1)  # 400 log10(7)


def match_of(points):
    """A match-up in which the player had so many points in each pair."""
    side = dict.fromkeys(("breaks", "runs", "called", "made", "safeties", "strokes", "simulated"), 1)
    pairs = [
        {"pair": pair, "agent": "v1", "of_player": side | {"points": mine, "seconds": 0.5, "fouls": {"R32": 1}}}
        | {"of_opponent": side | {"points": 2.0 - mine, "seconds": 0.1, "fouls": {}}}
        for pair, mine in enumerate(points)
    ]
    return search.match_row("a", "b", 1.0, "olympiad", pairs)


@pytest.mark.parametrize(
    ("points", "cells"),
    [
        ((1.5,), (0, 0, 0, 1, 0)),
        ((2.0, 2.0, 1.0, 0.5), (0, 1, 1, 0, 2)),
        ((2.0,) * 20, (0, 0, 0, 0, 20)),
        ((0.0, 1.0, 1.5) * 20, (20, 0, 20, 20, 0)),
    ],
)
def test_scores_are_as_sure_as_in_tournaments(points, cells):
    """One way to make an interval and an Elo difference of pairs: docs/tournaments.md, Scores."""
    row, score = match_of(points), score_of_cells(cells)
    told = [row[name] for name in ("score", "low_95", "high_95", "elo", "elo_low_95", "elo_high_95")]
    meant = [score.score, score.low, score.high, score.elo, score.elo_low, score.elo_high]
    assert told == pytest.approx(meant, abs=0.051)
    assert told[:3] == pytest.approx(meant[:3], abs=1e-4)


@pytest.mark.slow
def test_a_study_of_breaks_finds_one_that_goes_on():
    best, *others = search_breaks.study(EightBall(Table.olympiad()), 1.0, ((6, 10), (2, 20)))
    assert best["worth"] >= max(other["worth"] for other in others)
    assert best["goes_on"] > 0.7  # the studied break is among them; 0.98 of its breaks go on


def test_breaks_near_a_cushion_stay_on_the_table():
    """Seen: a neighbour's place lay beyond the cushion line, and a study of a quarter of an hour ended there."""
    table, chance = Table.nine_foot(), np.random.default_rng(1)
    state = EightBall(table).new_game(1).state
    for x in (table.ball_radius, table.width - table.ball_radius):
        for _ in range(50):
            one = search_breaks.near(table, Break(round(x, 4), table.head_string + 0.01, 9.0, 0.0, 0.0, 0.0), chance)
            one.stroke(table, state.moved(0, one.place))


def test_a_break_is_worth_the_best_answer_of_the_player_who_decides():
    """Games without a decision are valued as they lie; with one, seat 1 takes what is worst for the breaker."""
    rules = EightBall(Table.olympiad())
    lies = rules.new_game(1).state.moved(0, (0.4, 1.2))
    mine, theirs = (Game(lies, Phase.PLAY, seat, 0) for seat in (0, 1))
    decisions = (Decision.ACCEPT_TABLE, Decision.RERACK_AND_BREAK)
    choosing = Game(lies, Phase.DECISION, 1, 0, decisions=decisions, choice=RuleId.R12)
    rulings = [Ruling((), (), "", (), game) for game in (mine, theirs, choosing)]
    first, second, third = search_breaks.worth(rules, 1.0, rulings).tolist()
    assert first == pytest.approx(1.0 - second)
    assert third == pytest.approx(min(second, 1.0 - worth_of_breaking(rules.table, 1.0)))


def test_habits_are_counted():
    tables = search_habits.played(1.0, 1)
    rows = search_habits.arrival_rows(1.0, tables)
    assert [row["arrival"] for row in rows] == list(search_habits.ARRIVALS)
    assert sum(row["strokes"] for row in search_habits.worth_rows(1.0, tables)) > 0


def test_versions_that_play_differently_are_kept_apart(monkeypatch):
    """The strength is the present version's; what a part was worth is told of every version."""
    side = dict.fromkeys(("breaks", "runs", "called", "made", "safeties", "strokes", "simulated"), 1)
    counts = side | {"points": 1.0, "seconds": 0.5, "fouls": {}}

    def line(agent, opponent, pairs):
        of = {"player": "search:shots=9,cpu=on", "opponent": opponent, "noise": 1.0, "agent": agent}
        return {
            "tables": {"pairs": [of | {"pair": pair, "of_player": counts, "of_opponent": counts} for pair in pairs]}
        }

    lines = [
        line("v3", "greedy", (0, 1)),
        line("v2", "greedy", (1, 2)),
        line("v1", "greedy", (0,)),
        line("v0", "x", (0,)),
    ]
    lines.append(line("v1", "search:shots=9,ways=off", (0, 1)))
    monkeypatch.setattr(recording, "lines", lambda name: lines)
    tables = search.pool([["v3", "v2"], ["v1"]])
    assert [(row["opponent"], row["agents"], row["pairs"]) for row in tables["matches"]] == [
        ("greedy", "v2 v3", 3),
        ("greedy", "v1", 1),
        ("search:shots=9,ways=off", "v1", 2),
    ]
    assert [(row["player"], row["games"]) for row in tables["strength"]] == [("search:shots=9", 6)]
    assert [(row["part"], row["agents"], row["games"], row["elo"]) for row in tables["parts"]] == [
        ("ways", "v1", 4, 0.0)
    ]


def test_odds_that_games_bear_out_are_found_in_them():
    """Games won with known odds; Odds(0, 1) is the race itself."""
    chance = np.random.default_rng(1)
    race = chance.uniform(0.02, 0.98, 20_000)
    assert Odds(0.0, 1.0).of(race) == pytest.approx(race)
    true = Odds(-0.3, 0.6)
    found = search_odds.fitted(race, (chance.random(len(race)) < true.of(race)).astype(float))
    assert found.shift == pytest.approx(-0.3, abs=0.05)
    assert found.scale == pytest.approx(0.6, abs=0.05)
