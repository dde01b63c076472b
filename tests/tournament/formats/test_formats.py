"""Formats (docs/tournaments.md, "Formats"): everybody meets as often as promised, whatever the results."""

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.events import by_lot, play, result_of, spec_of

from tournament import InvalidResult, Tournament, standings
from tournament.formats.knockout import bracket
from tournament.pairings import Pair

sizes = st.integers(2, 9)
seeds = st.integers(0, 2**32)


def met(event: Tournament) -> Counter[frozenset[str]]:
    """How often two names met, in meetings."""
    return Counter(frozenset(meeting.players) for meeting in event.meetings)


def assert_pairs_are_fair(event: Tournament) -> None:
    """Each pair: two games, same players and level, each breaks once; racks shared, noise not."""
    for pair in event.pairs:
        games = event.of_pair(pair)
        assert [game.breaker for game in games] == [0, 1]
        assert {game.players for game in games} == {pair.players}
        assert {game.noise for game in games} == {pair.noise}


@given(sizes, st.integers(1, 3), seeds)
@settings(max_examples=40, deadline=None)
def test_in_a_round_robin_everybody_meets_everybody_once(entrants, pairs, seed):
    event = play(Tournament(spec_of(entrants, pairs=pairs, seeding="drawn", seed=seed)), by_lot(seed))
    assert set(met(event).values()) == {1}
    assert len(met(event)) == entrants * (entrants - 1) // 2
    assert Counter(game.pair for game in event.results).keys() == {pair.id for pair in event.pairs}
    assert_pairs_are_fair(event)
    for around in {pair.round for pair in event.pairs}:
        busy = Counter(name for one in event.meetings if one.round == around for name in one.players)
        resting = [bye.player for bye in event.byes if bye.round == around]
        assert sorted([*busy, *resting]) == sorted(event.spec.names)
        assert set(busy.values()) == {1}


@given(sizes, st.data())
@settings(max_examples=30, deadline=None)
def test_in_a_gauntlet_each_challenger_meets_all_others_and_no_challenger(entrants, data):
    challengers = data.draw(st.integers(1, entrants - 1))
    event = play(Tournament(spec_of(entrants, format="gauntlet", challengers=challengers)), by_lot(1))
    names = event.spec.names
    expected = {frozenset((one, other)) for one in names[:challengers] for other in names[challengers:]}
    assert met(event) == Counter(dict.fromkeys(expected, 1))
    for around in {pair.round for pair in event.pairs}:
        busy = Counter(name for one in event.meetings if one.round == around for name in one.players)
        assert set(busy.values()) == {1}


@given(st.integers(2, 9), st.data(), seeds)
@settings(max_examples=40, deadline=None)
def test_a_swiss_gives_nobody_two_byes_or_a_rematch_while_that_can_be_avoided(entrants, data, seed):
    """Up to half the entrants' number of rounds it can always be avoided: any graph whose vertices have at least
    n/2 neighbours has a perfect matching (Dirac 1952).
    """
    even = entrants + entrants % 2
    rounds = data.draw(st.integers(1, max(1, even // 2)))
    event = play(Tournament(spec_of(entrants, format="swiss", rounds=rounds, seed=seed)), by_lot(seed))
    assert max(met(event).values()) == 1
    assert set(Counter(bye.player for bye in event.byes).values()) <= {1}
    assert len(event.byes) == rounds * (entrants % 2)
    assert len(event.pairs) == rounds * (entrants // 2)
    assert_pairs_are_fair(event)


def test_a_swiss_of_more_rounds_than_opponents_meets_again_and_goes_on():
    event = play(Tournament(spec_of(3, format="swiss", rounds=7)), by_lot(3))
    assert sorted(met(event).values()) == [2, 2, 3]
    assert sorted(Counter(bye.player for bye in event.byes).values()) == [2, 2, 3]


def test_a_swiss_pairs_equal_points_top_half_against_bottom_half():
    """FIDE Handbook C.04.3: in a score group, S1 against S2. Eight equal entrants: 1-5, 2-6, 3-7, 4-8."""
    event = Tournament(spec_of(8, format="swiss", rounds=3))
    assert [pair.players for pair in event.pairs] == [("a", "e"), ("b", "f"), ("c", "g"), ("d", "h")]
    event = event.with_results(*(result_of(due, 0) for due in event.due))
    assert [pair.players for pair in event.pairs[4:]] == [("a", "c"), ("b", "d"), ("e", "g"), ("f", "h")]


def test_the_bye_of_a_swiss_goes_to_the_last_and_is_worth_a_meeting():
    event = Tournament(spec_of(5, format="swiss", rounds=1))
    assert [bye.player for bye in event.byes] == ["e"]
    event = play(event, lambda due: None)
    assert {one.name: one.points for one in standings(event)} == {"a": 0.5, "b": 0.5, "c": 0.5, "d": 0.5, "e": 1.0}


@given(st.integers(2, 17), st.integers(0, 2), st.sampled_from(["seed", "lot"]), seeds)
@settings(max_examples=40, deadline=None)
def test_a_knockout_ends_with_one_who_lost_to_nobody(entrants, extra, drawn, seed):
    event = play(
        Tournament(spec_of(entrants, format="knockout", extra_pairs=extra, drawn=drawn, seed=seed)), by_lot(seed)
    )
    assert len(event.meetings) == entrants - 1
    first, *others = standings(event)
    assert first.rank == 1
    assert others[0].rank == 2
    lost = {name for one in event.meetings for name in one.players if one.winner not in (None, name)}
    assert first.name not in lost
    assert len({pair.number for pair in event.pairs}) == len(event.pairs)
    assert max(met(event).values()) == 1


def test_the_bracket_keeps_the_best_apart():
    """The usual draw of sixteen: seed sums of 17 in the first round, then of 9, 5, 3 if the better seed always wins."""
    line = [int(name) for name in bracket([str(seed) for seed in range(1, 17)])]
    while len(line) > 1:
        couples = list(zip(line[::2], line[1::2], strict=True))
        assert {one + other for one, other in couples} == {len(line) + 1}
        line = [min(couple) for couple in couples]


def test_byes_of_a_knockout_go_to_the_best_seeds():
    event = Tournament(spec_of(5, format="knockout"))
    assert sorted(bye.player for bye in event.byes if bye.round == 0) == ["a", "b", "c"]


def test_a_drawn_meeting_gets_extra_pairs_one_by_one_and_then_the_better_seed_goes_on():
    event = Tournament(spec_of(2, format="knockout", pairs=1, extra_pairs=2))
    sizes_seen = []
    while not event.finished:
        sizes_seen.append(len(event.pairs))
        event = event.with_results(*(result_of(due, None) for due in event.due))
    assert sizes_seen == [1, 2, 3]
    assert standings(event)[0].name == "a"


def test_an_extra_pair_that_decides_is_the_last():
    event = Tournament(spec_of(2, format="knockout", pairs=1, extra_pairs=5))
    event = event.with_results(*(result_of(due, None) for due in event.due))
    b = event.due[0].pair.players.index("b")
    event = event.with_results(*(result_of(due, b) for due in event.due))
    assert event.finished
    assert [one.name for one in standings(event)] == ["b", "a"]


@given(st.sampled_from(["round_robin", "gauntlet", "swiss", "knockout"]), st.integers(2, 8), seeds)
@settings(max_examples=40, deadline=None)
def test_what_was_certain_stays_and_nothing_depends_on_the_order_of_completion(kind, entrants, seed):
    spec = spec_of(entrants, format=kind, seed=seed, **({"rounds": 3} if kind == "swiss" else {}))
    choose = by_lot(seed)
    event = Tournament(spec)
    before: tuple[Pair, ...] = ()
    while not event.finished:
        assert [pair for pair in event.pairs if pair in before] == sorted(before, key=lambda pair: pair.number)
        before = event.pairs
        event = event.with_results(*(result_of(due, choose(due)) for due in event.due))
    again = Tournament(spec, tuple(reversed(event.results)))
    assert again.pairs == event.pairs
    assert again.counted == event.counted
    assert standings(again) == standings(event)


def test_a_result_of_another_event_is_refused():
    event = Tournament(spec_of(2))
    other = Tournament(spec_of(4)).due[-1]
    with pytest.raises(InvalidResult, match=r"pair = 'r2-m1-p0': must be a pair of this event"):
        _ = event.with_results(result_of(other, 0)).due


def test_a_game_has_one_result():
    event = Tournament(spec_of(2))
    due = event.due[0]
    with pytest.raises(InvalidResult, match="one result that counts"):
        event.with_results(result_of(due, 0), result_of(due, 1))
