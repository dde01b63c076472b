"""Lock-step games of `benchmarks.lockstep`, and what `benchmarks.strength` says of them."""

from collections import Counter

import numpy as np
import pytest

import physics
from benchmarks import choices, contest, recording, strength
from benchmarks.lockstep import MatchUp, Played, Turn, play
from client.agents.search.evaluate import Question, Responder
from client.agents.search.sight import Sight
from client.agents.search.value import Values

QUICK = MatchUp(("search:shots=150", "search:shots=150,safeties=off"), noise=2.0, pairs=3, seed=4)


def told(games):
    return [
        (game.pair, game.breaker, game.winner, [(turn.seat, turn.worth, turn.made) for turn in game.turns])
        for game in games
    ]


def test_games_that_advance_together_are_those_played_alone():
    """What else is in the batch changes nothing: three pairs together, and the last of them alone."""
    together = play(QUICK)
    assert [(game.pair, game.breaker) for game in together] == [(p, b) for p in range(3) for b in (0, 1)]
    alone = play(MatchUp(QUICK.players, QUICK.noise, seed=QUICK.seed, first=2, pairs=1))
    assert told(together[4:]) == told(alone)
    assert sum(len(game.turns) for game in together) > 20


def test_answers_to_many_questions_are_the_answers_to_each():
    table = physics.Table.olympiad()
    responder = Responder(table, Values(Sight(table, 1.0), 1.0), physics.simulate_batch)
    positions = np.full((1, 16, 2), np.nan)
    positions[0, [0, 1, 8, 9]] = (0.5, 1.9), (0.3, 1.8), (0.8, 1.2), (0.9, 0.4)

    def question(count, judged, kitchen=False):
        strokes = np.array([[1.0 + 0.5 * n, 200.0 + 6.0 * n, 2.0, 0.0, 0.0] for n in range(count)])
        ball, pocket = np.full(count, 1), np.zeros(count, np.int64)
        before = np.repeat(positions, count, axis=0)
        return Question(before, strokes, np.zeros(count, np.int8), ball, pocket, kitchen, judged)

    asked = [question(3, True), question(5, False), question(4, True, kitchen=True)]
    together, alone = responder.answers(asked), [responder.answer(one) for one in asked]
    assert together[0] == pytest.approx(alone[0])
    assert together[2] == pytest.approx(alone[2])
    assert np.array_equal(together[1].positions, alone[1].positions, equal_nan=True)
    assert (alone[0][:3] != alone[2][:3]).any()  # R38: from the kitchen the same strokes foul


def test_a_player_with_a_clock_thinks_alone():
    """Its seconds are its own: they do not pass while others think, and they are told."""
    games = play(MatchUp(("search:seconds=0.02,cpu=on", "search:shots=3000"), noise=1.0, pairs=4, seed=2))
    strokes, seconds = (sum(getattr(game, name)[0] for game in games) for name in ("strokes", "seconds"))
    simulated = sum(game.simulated[0] for game in games)
    assert seconds > 0.0
    assert sum(game.seconds[1] for game in games) == 0.0
    assert simulated > 50 * strokes


def test_another_agent_may_sit_there():
    (game, _) = play(MatchUp(("random", "search:shots=100"), noise=1.0, pairs=1, seed=1))
    assert game.winner in (0, 1)
    assert {turn.worth is None for turn in game.turns if turn.seat == 0} <= {True}


def played(pair, breaker, winner, turns=(), strokes=(1, 1)):
    return Played(pair, breaker, winner, list(turns), run_out=winner == breaker, strokes=list(strokes))


def test_the_score_is_of_pairs():
    games = [played(0, 0, 0), played(0, 1, 0), played(1, 0, 1, strokes=(0, 5)), played(1, 1, None)]
    row = strength.match_row(MatchUp(("a", "b"), 1.0), games)
    assert (row["pairs"], row["score"], row["cells_4"], row["cells_1"]) == (2, 0.625, 1, 1)
    assert (row["lost"], row["lost_winnable"]) == (1, 0)  # it never came to the table
    assert (row["break_and_run"], row["opponent_lost"]) == (0.5, 2)
    assert (row["breaks_kept"], row["breaks_won"], row["opponent_breaks_won"]) == (0.0, 0.5, 0.0)


def test_a_break_is_kept_when_its_player_shoots_next():
    """The first called stroke of a game tells, unless the opponent decided something before it."""
    games = play(MatchUp(("search:shots=60",) * 2, noise=5.0, pairs=4, seed=4))
    assert {game.kept for game in games} == {True, False}
    for game in games:
        assert game.kept <= (game.turns[0].seat == game.breaker)
        assert game.run_out <= game.kept


def test_ends_of_turns_have_causes():
    """By the best straight pot: a ball before a pocket, a far thin cut, none."""

    def at(cue, ball, called=True, goes_on=False):
        positions = np.full((16, 2), np.nan)
        positions[[0, 1, 8]] = cue, ball, (0.56, 1.12)
        return Turn(0, positions, 0, called, False, goes_on, 0.5)

    easy, none = at((0.3, 0.3), (0.1, 0.1)), at((0.56, 1.3), (0.56, 0.9))
    turns = [easy, at((0.3, 0.3), (0.1, 0.1), called=False), none, at((0.3, 0.3), (0.1, 0.1), goes_on=True)]
    row = strength.end_row(MatchUp(("a", "b"), 1.0), [played(0, 0, 1, turns)], 0)
    assert {cause: row[cause] for cause in strength.CAUSES} == Counter(no_pot=1, easy_missed=1, easy_declined=1) | {
        "hard": 0, "fair": 0,
    }  # fmt: skip
    won = strength.end_row(MatchUp(("a", "b"), 1.0), [played(0, 0, 0, turns[:1])], 0)
    assert won["turns"] == 0


def test_what_was_reckoned_is_compared_with_what_was_won():
    turns = [Turn(0, np.zeros((16, 2)), 0, True, True, True, worth) for worth in (0.95, 0.91, 0.2)]
    rows = strength.reckoned_rows(MatchUp(("a", "b"), 1.0), [played(0, 0, 0, turns)], 0)
    assert [(row["from"], row["strokes"], row["won"]) for row in rows] == [(0.2, 1, 1.0), (0.9, 2, 1.0)]
    assert strength.log_loss(np.array([0.5, 0.5]), np.array([1.0, 0.0])) == pytest.approx(np.log(2.0), abs=1e-4)


def test_choices_are_judged_in_the_same_positions():
    """The first player is the measure of the others; the same run gives the same rows."""
    players = ("shots=200", "shots=200,polish=off")
    rows = list(choices.rows("olympiad", 2.0, players, 3, 40))
    assert [row["player"] for row in rows] == list(players)
    assert rows[0]["gain"] == 0.0
    assert all(0.0 < row["worth"] < 1.0 and row["positions"] == 3 for row in rows)
    assert rows == list(choices.rows("olympiad", 2.0, players, 3, 40))


def test_lines_are_pooled_row_by_row(monkeypatch):
    def line(name, score):
        return {"id": name, "tables": {"matches": [{"score": score}], "ends": [], "reckoned": []}}

    monkeypatch.setattr(recording, "lines", lambda _: [line("a", 0.5), line("b", 0.6), line("c", 0.7)])
    assert strength.pooled(["c", "a"])["matches"] == [{"score": 0.7, "line": "c"}, {"score": 0.5, "line": "a"}]
    with pytest.raises(ValueError, match="line = 'd': must be the id of a line"):
        strength.pooled(["c", "d"])


def test_a_contest_counts_runs_and_pairs():
    games = [played(0, 0, 0), played(0, 1, 0), played(1, 0, 1), played(1, 1, 1)]
    assert contest.points(games) == Counter({4: 1, 0: 1})
    assert contest.runs(games, 0, "run")["run"] == 0.5
    row = contest.runs(games, 1, "run")
    assert (row["run"], row["run_low_95"] < 0.5 < row["run_high_95"]) == (0.5, True)


def test_pots_and_safeties_are_told_apart():
    """What each was reckoned to be worth beside what its player won; draws and untold worths count for nothing."""
    lies = np.full((16, 2), np.nan)
    turns = [
        Turn(0, lies, 0, True, True, True, 0.9),
        Turn(0, lies, 0, False, False, False, 0.6),
        Turn(0, lies, 0, True, True, True, None),
    ]
    games = [Played(0, 0, winner=0, turns=turns), Played(1, 0, winner=1, turns=turns), Played(2, 0, turns=turns)]
    rows = strength.call_rows(MatchUp(("a", "b"), 1.0), games, 0)
    assert [(row["call"], row["strokes"], row["reckoned"], row["won"]) for row in rows] == [
        ("ball", 2, 0.9, 0.5),
        ("safety", 2, 0.6, 0.5),
    ]
    assert strength.call_rows(MatchUp(("a", "b"), 1.0), games, 1) == []


def test_lines_of_different_columns_are_put_together():
    """Seen: a column that earlier lines lack ended the command that pools them."""
    assert strength._filled([{"a": 1}, {"a": 2, "b": 3}]) == [{"a": 1, "b": None}, {"a": 2, "b": 3}]
