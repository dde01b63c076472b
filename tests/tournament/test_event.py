"""An event as it goes on: replayed games, withdrawals, seeds (docs/tournaments.md, "Events")."""

import pickle
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.events import by_lot, play, result_of, spec_of

from referee.game import EndReason
from tournament import GameResult, InvalidResult, NoisePlan, Tournament, game_seeds, standings


def test_the_games_of_a_pair_share_racks_and_never_noise():
    """Else the second game could be played with the first one's noise known."""
    spec = spec_of(3, pairs=2)
    dues = Tournament(spec).due
    seeds = {due.id: game_seeds(spec, due.pair, due.leg) for due in dues}
    for one, other in combinations(dues, 2):
        same = one.pair == other.pair
        assert (seeds[one.id].racks == seeds[other.id].racks) == same
        assert seeds[one.id].noise != seeds[other.id].noise


def test_a_game_played_again_has_noise_of_its_own():
    spec = spec_of(2)
    pair = Tournament(spec).due[0].pair
    first, again = game_seeds(spec, pair, 0, 0), game_seeds(spec, pair, 0, 1)
    assert first.racks == again.racks
    assert first.noise != again.noise


def test_seeds_depend_on_the_events_seed_alone():
    pair = Tournament(spec_of(2)).due[0].pair
    assert game_seeds(spec_of(2), pair, 0) == game_seeds(spec_of(2), pair, 0)
    assert game_seeds(spec_of(2, seed=1), pair, 0) != game_seeds(spec_of(2, seed=2), pair, 0)
    assert game_seeds(spec_of(2, seed="00" * 32), pair, 0) != game_seeds(spec_of(2, seed=0), pair, 0)


def test_variable_levels_fill_the_range_and_are_the_pairs_own():
    levels = [pair.noise for pair in Tournament(spec_of(2, pairs=400, noise=NoisePlan.variable(1.0, 4.0))).pairs]
    assert 1.0 <= min(levels) < 1.1
    assert 3.9 < max(levels) <= 4.0
    assert len(set(levels)) == 400


def test_several_levels_come_in_turn():
    levels = [pair.noise for pair in Tournament(spec_of(2, pairs=5, noise=NoisePlan((0.0, 1.0)))).pairs]
    assert levels == [0.0, 1.0, 0.0, 1.0, 0.0]


def test_a_void_game_is_due_again():
    event = play(Tournament(spec_of(2)), lambda due: 0)
    assert event.finished
    event = event.voided("r0-m0-p0", 1)
    (due,) = event.due
    assert (due.leg, due.attempt, due.id) == (1, 1, "r0-m0-p0-g1-a1")
    assert len(event.counted) == 1
    event = event.with_results(result_of(due, 1))
    assert event.finished
    assert len(event.results) == 3


def test_an_aborted_game_is_due_again():
    event = Tournament(spec_of(2))
    due = event.due[0]
    aborted = GameResult(due.pair.id, 0, due.pair.players, 0, None, EndReason.ABORTED)
    event = event.with_results(aborted)
    assert event.due[0].attempt == 1
    assert event.counted == ()


def test_a_round_that_another_was_drawn_from_stands():
    event = Tournament(spec_of(4, format="swiss", rounds=2))
    event = event.with_results(*(result_of(due, 0) for due in event.due))
    assert event.voided("r0-m0-p0", 0).due
    event = event.with_results(result_of(event.due[0], 0))
    with pytest.raises(InvalidResult, match="no later round or extra pair has followed from"):
        event.voided("r0-m0-p0", 0)


def test_a_pair_that_an_extra_pair_followed_from_stands():
    """Seen: void, it took the extra pair out of the plan, and the event with its result could not be read any more."""
    event = Tournament(spec_of(2, format="knockout"))
    event = event.with_results(*(result_of(due, None) for due in event.due))
    assert event.voided("r0-m0-p0", 0).due
    event = event.with_results(result_of(event.due[0], 0))
    with pytest.raises(InvalidResult, match="no later round or extra pair has followed from"):
        event.voided("r0-m0-p0", 0)
    assert event.voided("r0-m0-p1", 0).due


def test_a_plan_that_cannot_change_is_made_once():
    """Else an event of many games would plan them all again after each of them."""
    event = Tournament(spec_of(4))
    plan = event.plan
    event = event.with_results(result_of(event.due[0], 0))
    assert event.plan is plan
    assert len(event.due) == 11
    stray = result_of(Tournament(spec_of(8)).due[-1], 0)
    with pytest.raises(InvalidResult, match="a pair of this event"):
        event.with_results(stray)
    assert event.voided("r0-m0-p0", 0).plan == plan


def test_only_a_game_with_a_result_can_be_void():
    with pytest.raises(InvalidResult, match="a game with a result"):
        Tournament(spec_of(2)).voided("r0-m0-p0", 0)


@given(
    st.sampled_from(["round_robin", "gauntlet", "swiss", "knockout"]),
    st.integers(2, 7),
    st.integers(0, 40),
    st.integers(0, 2**16),
)
@settings(max_examples=60, deadline=None)
def test_an_event_goes_on_to_its_end_without_the_disqualified(kind, entrants, after, seed):
    spec = spec_of(entrants, format=kind, **({"rounds": 3} if kind == "swiss" else {}))
    event, choose = Tournament(spec), by_lot(seed)
    for _ in range(after):
        if event.due:
            event = event.with_results(result_of(event.due[0], choose(event.due[0])))
    played = event.results
    out = spec.names[seed % entrants]
    event = event.disqualified(out)
    assert event.results[: len(played)] == played
    assert not any(out in due.pair.players for due in event.due)
    end = play(event, choose)
    assert not any(out in due.pair.players for due in end.due)
    assert {line.name for line in standings(end) if line.withdrawn} == {out}
    lost = end.results[len(played) :]
    assert all(game.points_of(out) == 0.0 for game in lost if out in game.players)


@pytest.mark.parametrize(
    ("terms", "won", "planned"),
    [
        ({"pairs": 1, "extra_pairs": 2}, 1, 1),
        ({"pairs": 3, "extra_pairs": 2}, 4, 3),
        ({"pairs": 1, "extra_pairs": 2}, 3, 2),
    ],
    ids=["even after the forfeits", "ahead in spite of them", "in an extra pair"],
)
def test_who_is_disqualified_in_a_meeting_of_a_knockout_goes_no_further(terms, won, planned):
    """Seen: an extra pair against nobody, or the next round for the one who was out."""
    event = Tournament(spec_of(4, format="knockout", **terms))
    out, other = event.due[0].pair.players
    for number in range(won):
        # the first pair is drawn where there is to be an extra one
        winner = other if planned > terms["pairs"] and number == 1 else out
        due = next(due for due in event.due if out in due.pair.players)
        event = event.with_results(result_of(due, due.pair.players.index(winner)))
    event = event.disqualified(out)
    assert not any(out in due.pair.players for due in event.due)
    assert sum(out in pair.players for pair in event.pairs) == planned
    assert event.plan.advanced == {other: 1}
    end = play(event, lambda due: 0)
    assert {line.name: line.points for line in standings(end)}[out] == 0
    assert sum(other in one.players for one in end.meetings) == 2, "the final is the other one's"


def test_who_is_disqualified_after_its_meeting_stays_its_winner():
    event = Tournament(spec_of(4, format="knockout"))
    event = event.with_results(*(result_of(due, 0) for due in event.due if due.pair.meeting == 0))
    (winner,) = event.plan.advanced
    end = play(event.disqualified(winner), lambda due: 0)
    assert end.plan.advanced[winner] == 1
    assert [bye.round for bye in end.byes] == [1], "for whoever would have met it"


def test_a_game_of_one_who_has_left_is_not_played_again():
    event = Tournament(spec_of(2))
    event = event.with_results(result_of(event.due[0], 0)).disqualified("a")
    with pytest.raises(InvalidResult, match="a has left"):
        event.voided("r0-m0-p0", 0)


def test_nobody_else_can_be_disqualified():
    with pytest.raises(InvalidResult, match="name = 'z': must be an entrant of event"):
        Tournament(spec_of(2)).disqualified("z")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"winner": 2}, "winner = 2"),
        ({"winner": True}, "winner = True"),
        ({"leg": 2}, "leg = 2"),
        ({"players": ["a", "a"]}, "two different names"),
        ({"players": ["a"]}, "players = ['a']: must be a list of 2"),
        ({"players": "ab"}, "players = 'ab': must be a list of 2"),
        ({"players": ["a", "b\n"]}, "players[1] = 'b\\n': must be 1 to 64 printable letters"),
        ({"players": ["a", "x" * 65]}, "must be 1 to 64 printable letters"),
        ({"fouls": [{"R\n": 1}, {}]}, "fouls[0].'R\\n' = 'R\\n': must be 1 to 64 printable letters"),
        ({"attempt": 10**13}, "attempt = 10000000000000: must be an integer"),
        ({"seconds": [10**400, 0]}, "seconds[0] = 1000"),
        ({"breaker": "1"}, "breaker = '1': must be an integer from 0 to 1"),
        ({"reason": "bored"}, "reason = 'bored': must be one of eight_made"),
        ({"seconds": [float("inf"), 0]}, "seconds[0] = inf: must be a number from 0 to 1e+12"),
        ({"strokes": [-1, 0]}, "strokes[0] = -1: must be an integer from 0 to"),
        ({"fouls": [{"R33": 1.5}, {}]}, "fouls[0].R33 = 1.5: must be an integer"),
        ({"fouls": [3, {}]}, "fouls[0] = 3: must be an object (a table)"),
        ({"noise": 9.0}, "noise = 9.0"),
        ({"record": 3}, "record = 3"),
        ({"reason": "aborted"}, "nobody wins an aborted game"),
        ({"void": 1}, "void = 1"),
        ({"shoes": "red"}, "shoes = 'red': must be left out; the fields are pair, leg"),
    ],
)
def test_a_result_that_cannot_be_is_named(change, words):
    good = result_of(Tournament(spec_of(2)).due[0], 0).to_dict()
    assert GameResult.from_dict(good).to_dict() == good
    with pytest.raises(InvalidResult) as error:
        GameResult.from_dict(good | change)
    assert words in str(error.value)


def test_events_and_errors_cross_process_borders():
    event = play(Tournament(spec_of(3)), by_lot(1))
    with pytest.raises(InvalidResult) as raised:
        event.disqualified("z")
    assert str(pickle.loads(pickle.dumps(raised.value))) == str(raised.value)
    assert pickle.loads(pickle.dumps(event.results)) == event.results
    assert pickle.loads(pickle.dumps(event.spec)) == event.spec
