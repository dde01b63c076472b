"""Whole games and matches without a server."""

import itertools
from dataclasses import dataclass, field
from typing import Any

import pytest
from support.players import Potter

from client.local_game import TRIES, BadAnswer, Lost, Watch, play_game, play_match, points_of
from physics import Shot, Table
from protocol import View
from referee.game import Action, EndReason, Outcome
from referee.play import MatchSeed, NoiseModel
from referee.play.clock import Timing
from referee.play.stroke import Refused
from referee.record import line_digest, verify_record
from referee.rules import EightBall

RULES = EightBall(Table.olympiad())
NOISE = NoiseModel(1.0)


@dataclass
class Spy:
    """A player that keeps the views it was shown."""

    player: Potter
    views: list[View] = field(default_factory=list)

    def __call__(self, view):
        self.views.append(view)
        return self.player(view)


def raises(_view):
    raise RuntimeError("no idea")


def nonsense(_view):
    return "shoot!"


def refused(_view):
    return Action(Shot(5.0, 270.0, 5.0), call="safety", cue_ball=(0.5, 0.5))


def game_of(first, second, seed=1, **options):
    return play_game(RULES, (first, second), MatchSeed.of(seed).game(0), NOISE, **options)


def bits(game):
    return list(game.record())


@pytest.mark.parametrize("seed", range(6))
def test_games_end_by_the_rules(seed):
    game = game_of(Potter("a"), Potter("b"), seed)
    assert game.outcome == game.strokes[-1].game.outcome
    assert [stroke.index for stroke in game.strokes if stroke.index is not None] == list(
        range(game.strokes[-1].game.stroke)
    )


def test_the_same_seed_is_the_same_game():
    assert bits(game_of(Potter("a"), Potter("b"))) == bits(game_of(Potter("a"), Potter("b")))
    assert bits(game_of(Potter("a"), Potter("b"))) != bits(game_of(Potter("a"), Potter("b"), seed=2))


def test_players_see_their_own_turns_and_what_happened_since():
    first, second = Spy(Potter("a")), Spy(Potter("b"))
    game = game_of(first, second)
    assert len(first.views) + len(second.views) == len(game.strokes)
    for seat, spy in enumerate((first, second)):
        for view in spy.views:
            assert (view.seat, view.turn) == (seat, seat)
            assert view.my_turn
            since = view.strokes_since
            assert [stroke.index for stroke in since] == list(range(view.version - len(since), view.version))
            assert seat not in [stroke.seat for stroke in since[1:]]
            assert not since or since[0].seat == seat or since[0].index == 0
            assert view.balls == {ball: view.to_game().state.position(ball) for ball in view.balls}


def test_no_view_holds_anything_that_yields_noise():
    first, second = Spy(Potter("a")), Spy(Potter("b"))
    game = game_of(first, second)
    seeds = game.seeds
    text = "".join(view.model_dump_json() for view in first.views + second.views)
    assert game.header.commitment in text
    for secret in (
        seeds.noise,
        seeds.noise_seed,
        seeds.racks,
        seeds.rack_seed,
        *(seeds.rack(n) for n in range(3)),
        MatchSeed.of(1).secret,
    ):
        assert secret.hex() not in text


def test_the_level_is_shown_only_when_told():
    first = Spy(Potter("a"))
    play_game(RULES, (first, first), MatchSeed.of(1).game(0), NoiseModel(2.0, told=False))
    assert {view.noise.level for view in first.views} == {None}


@pytest.mark.parametrize(("player", "reason"), [(raises, RuntimeError), (nonsense, BadAnswer), (refused, Refused)])
def test_bad_actions_are_told_tried_again_and_in_the_end_forfeit_the_game(player, reason):
    bad: list[Any] = []
    game = game_of(player, Potter("b"), watch=Watch(on_refusal=bad.append))
    assert game.outcome == Outcome(1, EndReason.FORFEIT, "R48")
    assert game.strokes == ()
    assert [one.attempt for one in bad] == list(range(1, TRIES + 1))
    assert all(isinstance(one.reason, reason) and one.seat == 0 for one in bad)


def test_a_good_action_after_bad_ones_is_played():
    player, attempts = Potter("a"), []

    def clumsy(view):
        attempts.append(view.version)
        return player(view) if len(attempts) % 3 == 0 else nonsense(view)

    game = game_of(clumsy, Potter("b"))
    assert game.outcome.reason is not EndReason.FORFEIT
    assert len(attempts) == 3 * sum(stroke.seat == 0 for stroke in game.strokes)


def test_leaving_is_not_a_bad_action():
    def interrupted(_view):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        game_of(interrupted, Potter("b"))


def ticking(nanoseconds):
    """A time that goes on by so much at every look."""
    times = itertools.count(0, nanoseconds)
    return lambda: next(times)


def test_every_answer_is_charged_and_shown_and_recorded():
    spy = Spy(Potter("a"))
    game = game_of(spy, Potter("b"), timing=Timing(10**12, ticking(10**9)))
    assert set(game.elapsed_ns) == {10**9}
    left = [view.clocks[0].seconds_left for view in spy.views]
    assert left == [1000.0 - number for number in range(len(left))]
    assert verify_record(game.record()).ok


def test_a_clock_at_exactly_zero_loses_and_the_record_proves_it():
    """R48, docs/protocol.md: exactly zero left is out of time."""
    game = game_of(Potter("a"), Potter("b"), timing=Timing(3 * 10**9, ticking(10**9)))
    assert game.outcome.reason is EndReason.TIME_OUT
    used = sum(
        ns for ns, stroke in zip(game.elapsed_ns, game.strokes, strict=True) if stroke.seat == 1 - game.outcome.winner
    )
    assert used + max(game.after_ns) >= 3 * 10**9
    assert verify_record(game.record()).ok


def test_a_bad_answer_costs_its_time():
    """Seen: each of twenty tries had all that was left before the first one."""
    left = []

    def raises_late(view):
        left.append(view.clocks[0].seconds_left)
        raise RuntimeError("no idea")

    game = game_of(raises_late, Potter("b"), timing=Timing(3 * 10**9, ticking(10**9)))
    assert game.outcome == Outcome(1, EndReason.TIME_OUT, "R48")
    assert left == [3.0, 2.0, 1.0]
    assert verify_record(game.record()).ok


@pytest.mark.parametrize("reason", [EndReason.CRASH, EndReason.STALL, EndReason.TIME_OUT, EndReason.FORFEIT])
def test_a_player_who_is_out_loses_for_its_own_reason(reason):
    def out(_view):
        raise Lost(reason)

    game = game_of(out, Potter("b"))
    assert game.outcome == Outcome(1, reason, "R48")
    assert game.strokes == ()


def test_the_lines_told_as_they_happen_are_the_record():
    lines: list[str] = []
    game = game_of(Potter("a"), Potter("b"), watch=Watch(on_line=lines.append), match="m", game="g")
    assert [*lines, *game.last_lines(line_digest(lines[-1]))] == list(game.record())
    assert (game.header.terms.match, game.header.game) == ("m", "g")


def test_a_match_alternates_the_break_and_keeps_the_score():
    """R50."""
    seed, seen = MatchSeed.of(5), []

    def chairs(number, _budgets):
        spies = Spy(Potter(f"a{number}")), Spy(Potter(f"b{number}"))
        seen.append(spies)
        return spies

    games = list(play_match(RULES, chairs, seed, 4, NOISE, players=("ann", "bob")))
    assert [game.header.start.breaker for game in games] == [seed.breaker(number) for number in range(4)]
    assert len({game.header.commitment for game in games}) == 1
    assert len({game.seeds.noise_seed for game in games}) == 4
    assert all(verify_record(game.record()).ok for game in games)
    points = [points_of(game.outcome) for game in games]
    for number, spies in enumerate(seen):
        before = tuple(sum(pair[seat] for pair in points[:number]) for seat in (0, 1))
        shown = {view.score for spy in spies for view in spy.views}
        assert shown == {before}
        assert {view.number for spy in spies for view in spy.views} == {number}


@pytest.mark.parametrize(
    ("winner", "reason", "points"),
    [
        (0, EndReason.EIGHT_MADE, (1.0, 0.0)),
        (1, EndReason.TIME_OUT, (0.0, 1.0)),
        (None, EndReason.STALEMATE, (0.5, 0.5)),
        (None, EndReason.ABORTED, (0.0, 0.0)),
    ],
)
def test_points(winner, reason, points):
    assert points_of(Outcome(winner, reason, "R48")) == points
