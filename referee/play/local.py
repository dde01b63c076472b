"""Whole games and matches in one process, without server and clock: for local play, tests and experiments."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from referee.errors import RefereeError
from referee.game import Action, EndReason, Game, Outcome
from referee.play.noise import NoiseModel
from referee.play.seeds import GameSeeds, MatchSeed
from referee.play.stroke import Refused, Stroke, play_stroke, start_game
from referee.record import Header, record_lines
from referee.rules import EightBall
from referee.wire import ClockView, GameTerms, NoiseView, StrokeView, View
from referee.wire.strokes import since_own_last

Chooser = Callable[[View], Action]
"""Looks at a view and says what to do; may fail or answer nonsense."""

Chairs = tuple[Chooser, Chooser]
"""Who sits where: the choosers of seat 0 and seat 1."""

TRIES = 20
"""Bad actions in a row that a player may offer before the game is forfeit. Without a clock, somebody has to
end it; with the twentieth nonsense in a row nobody expects sense any more."""


class BadAnswer(RefereeError):
    """A chooser raised (that is then the cause), or returned something that is no action."""


@dataclass(frozen=True, slots=True)
class BadAction:
    """An answer that could not be played, and why: what ``on_refusal`` is told.

    Attributes:
        seat: who answered. attempt: how many bad answers in a row, this one included.
        reason: what the chooser raised, or what was wrong with its answer.
    """

    seat: int
    attempt: int
    reason: Exception


@dataclass(frozen=True)
class Watch:
    """Who is told what while a game goes on; nobody by default.

    Attributes:
        on_stroke: after every stroke and decision.
        on_refusal: after every bad action.
    """

    on_stroke: Callable[[Stroke], Any] = lambda stroke: None
    on_refusal: Callable[[BadAction], Any] = lambda bad: None


@dataclass(frozen=True, slots=True)
class PlayedGame:
    """A finished game.

    Attributes:
        header: its terms. strokes: strokes and decisions in order. outcome: the result.
        seeds: revealed, the game being over.
    """

    header: Header
    strokes: tuple[Stroke, ...]
    outcome: Outcome
    seeds: GameSeeds

    def record(self) -> Iterator[str]:
        """The record, line by line."""
        return record_lines(self.header, ((stroke, None) for stroke in self.strokes), self.outcome, self.seeds)


def play_game(
    rules: EightBall,
    chairs: Chairs,
    seeds: GameSeeds,
    noise: NoiseModel,
    *,
    breaker: int = 0,
    players: tuple[str, str] = ("seat 0", "seat 1"),
    number: int = 0,
    games: int = 1,
    score: tuple[float, float] = (0.0, 0.0),
    watch: Watch | None = None,
) -> PlayedGame:
    """Play one game to its end.

    A chooser that raises, answers nonsense or is refused is asked again; after ``TRIES`` bad answers in a row
    the game is forfeit.

    Args:
        rules: the referee, on its table.
        chairs: the choosers, by seat.
        seeds: of the game.
        noise: of the game.
        breaker: the seat that breaks.
        players: names, by seat.
        number, games, score: of the match, for the views.
        watch: who is told what.
    """
    start = start_game(rules, seeds, breaker)
    header = Header.of(
        rules,
        start,
        seeds,
        noise,
        game=f"local-{number}",
        match="local",
        number=number,
        players=players,
    )
    return _Table(header, chairs, seeds, _terms(header, games), score, watch or Watch()).play()


def play_match(
    rules: EightBall,
    seat_players: Callable[[int], Chairs],
    seed: MatchSeed,
    games: int,
    noise: NoiseModel,
    *,
    players: tuple[str, str] = ("seat 0", "seat 1"),
    watch: Watch | None = None,
) -> Iterator[PlayedGame]:
    """Play the games of a match one after the other, the break alternating.

    Args:
        seat_players: called with each game's number; gives the choosers for that game, fresh ones if need be.
        seed: everything random comes from it.
        games: how many.
        rules, noise, players, watch: as for ``play_game``.
    """
    score = (0.0, 0.0)
    for number in range(games):
        played = play_game(
            rules,
            seat_players(number),
            seed.game(number),
            noise,
            breaker=seed.breaker(number),
            players=players,
            number=number,
            games=games,
            score=score,
            watch=watch,
        )
        points = points_of(played.outcome)
        score = (score[0] + points[0], score[1] + points[1])
        yield played


def points_of(outcome: Outcome) -> tuple[float, float]:
    """What a game is worth by seat: 1 to the winner, half each for a draw, nothing when aborted."""
    if outcome.winner is None:
        half = 0.0 if outcome.reason is EndReason.ABORTED else 0.5
        return half, half
    return (1.0, 0.0) if outcome.winner == 0 else (0.0, 1.0)


@dataclass(slots=True)
class _Table:
    """A game being played."""

    header: Header
    chairs: Chairs
    seeds: GameSeeds
    terms: GameTerms
    score: tuple[float, float]
    watch: Watch

    def play(self) -> PlayedGame:
        """Play to the end."""
        game = self.header.start
        strokes: list[Stroke] = []
        history: list[StrokeView] = []
        while game.outcome is None:
            stroke = self._turn(game, history)
            if stroke is None:
                game = self.header.rules.end(game, EndReason.FORFEIT, game.turn).game
                continue
            history.append(StrokeView.of(stroke, len(strokes)))
            strokes.append(stroke)
            self.watch.on_stroke(stroke)
            game = stroke.game
        return PlayedGame(self.header, tuple(strokes), game.outcome, self.seeds)

    def _turn(self, game: Game, history: list[StrokeView]) -> Stroke | None:
        """The stroke of the player in turn; None after too many bad actions."""
        view = self._view(game, history)
        for attempt in range(1, TRIES + 1):
            try:
                action = self._asked(game.turn, view)
                return play_stroke(self.header.rules, game, action, self.seeds, self.header.noise)
            except (BadAnswer, Refused) as error:
                reason = error.__cause__ if isinstance(error.__cause__, Exception) else error
                self.watch.on_refusal(BadAction(game.turn, attempt, reason))
        return None

    def _asked(self, seat: int, view: View) -> Action:
        """What the player of ``seat`` says, whatever else its code may do."""
        try:
            action = self.chairs[seat](view)
        except Exception as error:
            raise BadAnswer("choose", type(error).__name__, "must return an Action") from error
        if not isinstance(action, Action):
            raise BadAnswer("choose", action, "must return an Action")
        return action

    def _view(self, game: Game, history: list[StrokeView]) -> View:
        seat = game.turn
        return View.of(
            self.terms,
            game,
            seat=seat,
            version=len(history),
            clocks=(
                ClockView(seconds_left=None, running=seat == 0),
                ClockView(seconds_left=None, running=seat == 1),
            ),
            score=self.score,
            strokes_since=since_own_last(history, seat),
        )


def _terms(header: Header, games: int) -> GameTerms:
    limits, noise = header.rules.limits, header.noise
    return GameTerms(
        game=header.game,
        match=header.match,
        number=header.number,
        games=games,
        players=header.players,
        rules="eight_ball",
        table=header.rules.table.to_dict(),
        noise=NoiseView(told=noise.told, level=noise.level if noise.told else None),
        dry_visits_limit=limits.dry_visits,
        replays_limit=limits.replays,
        strokes_limit=limits.strokes,
        commitment=header.commitment,
    )
