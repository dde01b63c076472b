"""Standings and tie-breaks (docs/tournaments.md, "Standings"), by hand."""

from hypothesis import given, settings
from hypothesis import strategies as st
from support.events import by_lot, play, spec_of

from tournament import TieBreak, Tournament, standings


def winner_by(table):
    """The seat whose player wins, from a set of (winner, loser); a draw for anybody else."""

    def choose(due):
        one, other = due.pair.players
        return 0 if (one, other) in table else 1 if (other, one) in table else None

    return choose


def test_points_then_the_games_among_the_tied():
    """a and b have 4 points each of 6 games; a won both against b."""
    table = {("a", "b"), ("b", "c"), ("b", "d"), ("a", "d"), ("c", "a"), ("c", "d")}
    event = play(Tournament(spec_of(4)), winner_by(table))
    lines = standings(event)
    assert [line.points for line in lines] == [4.0, 4.0, 4.0, 0.0]
    assert [line.tie_breaks[0] for line in lines] == [2.0, 2.0, 2.0, 0.0], "a circle: each took 2 points of 4"
    assert [line.rank for line in lines] == [1, 1, 1, 4]


def test_sonneborn_berger_counts_the_points_of_the_beaten():
    """a beats the second, b the last: the same points, a above b."""
    spec = spec_of(4, tie_breaks=(TieBreak.SONNEBORN_BERGER,))
    table = {("a", "c"), ("b", "d"), ("c", "d")}
    lines = {line.name: line for line in standings(play(Tournament(spec), winner_by(table)))}
    assert {name: line.points for name, line in lines.items()} == {"a": 4.0, "b": 4.0, "c": 3.0, "d": 1.0}
    # a: draws b and d, wins c: 0.5 * 4 + 0.5 * 1 + 3
    assert lines["a"].tie_breaks == (5.5,)
    # b: draws a and c, wins d: 0.5 * 4 + 0.5 * 3 + 1
    assert lines["b"].tie_breaks == (4.5,)
    assert (lines["a"].rank, lines["b"].rank) == (1, 2)


def test_buchholz_adds_the_opponents_points():
    event = play(Tournament(spec_of(4, format="swiss", rounds=2)), winner_by({("a", "c"), ("b", "d"), ("a", "b")}))
    lines = {line.name: line for line in standings(event)}
    assert lines["a"].points == 2.0
    assert lines["a"].tie_breaks[0] == lines["b"].points + lines["c"].points


@given(st.sampled_from(["round_robin", "gauntlet", "swiss", "knockout"]), st.integers(2, 8), st.integers(0, 2**16))
@settings(max_examples=40, deadline=None)
def test_what_is_won_is_lost_and_ranks_follow_points(kind, entrants, seed):
    event = play(Tournament(spec_of(entrants, format=kind, **({"rounds": 3} if kind == "swiss" else {}))), by_lot(seed))
    lines = standings(event)
    assert sum(line.score for line in lines) == len(event.results)
    assert sum(line.wins for line in lines) == sum(line.losses for line in lines)
    assert all(line.games == line.wins + line.draws + line.losses for line in lines)
    keys = [(-line.rank, line.points, line.tie_breaks) for line in lines]
    assert keys == sorted(keys, reverse=True)
    assert lines[0].rank == 1
