"""Whole games and matches in one process, without server and clock: for local play, tests and experiments."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from client import notebook
from protocol import BudgetView, ClockView, GameTerms, NoiseView, StrokeView, View
from protocol.strokes import since_own_last
from protocol.values import trusted
from referee.errors import RefereeError
from referee.game import Action, EndReason, Game, Outcome
from referee.play.budget import Budgets, GrantedBudget, budgets
from referee.play.clock import SECOND_NS, Clocks, Timing
from referee.play.noise import NoiseModel
from referee.play.seeds import GameSeeds, MatchSeed
from referee.play.stroke import Refused, Stroke, play_stroke
from referee.record import Chain, Header, MatchTerms, end_entry, record_lines, stroke_entry, unsigned_seal
from referee.rules import EightBall

Chooser = Callable[[View], Action]
"""Looks at a view and says what to do; may fail or answer nonsense."""

Chairs = tuple[Chooser, Chooser]
"""Who sits where: the choosers of seat 0 and seat 1."""

TRIES = 20
"""Bad actions in a row that a player may offer before the game is forfeit. Without a clock, somebody has to
end it; with the twentieth nonsense in a row nobody expects sense any more."""


class BadAnswer(RefereeError):
    """A chooser raised (that is then the cause), or returned something that is no action."""


class Lost(Exception):
    """Raised by a chooser: its player is out of this game, for a reason of R48 (crash, stall, time-out, ...)."""

    def __init__(self, reason: EndReason) -> None:
        super().__init__(reason.value)
        self.reason = reason


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
        on_line: every line of the record but the last two (``PlayedGame.last_lines``), the moment it is final; the
            first before the break.
    """

    on_stroke: Callable[[Stroke], Any] = lambda stroke: None
    on_refusal: Callable[[BadAction], Any] = lambda bad: None
    on_line: Callable[[str], Any] | None = None


@dataclass(frozen=True, slots=True)
class PlayedGame:
    """A finished game.

    Attributes:
        header: its terms. strokes: strokes and decisions in order. outcome: the result.
        seeds: revealed, the game being over.
        elapsed_ns: thinking time of each stroke and decision; Nones without clocks.
        after_ns: thinking time after the last of them, by seat.
        simulated: shots that each player simulated, by seat, as counted by the agents' simulators.
    """

    header: Header
    strokes: tuple[Stroke, ...]
    outcome: Outcome
    seeds: GameSeeds
    elapsed_ns: tuple[int | None, ...]
    after_ns: tuple[int, int] = (0, 0)
    simulated: tuple[int, int] = (0, 0)

    @property
    def _counted(self) -> tuple[int, int] | None:
        """What the record tells of simulated shots: nothing where no budget counts them."""
        return None if self.header.budget is None else self.simulated

    def __str__(self) -> str:
        """Who played, who won and why."""
        (one, other), outcome = self.header.players, self.outcome
        winner = "nobody" if outcome.winner is None else self.header.players[outcome.winner]
        return f"{one} against {other}: {winner} wins, {outcome.reason}, {len(self.strokes)} strokes"

    def __repr__(self) -> str:
        return f"<PlayedGame {self}>"

    def _repr_html_(self) -> str:
        return notebook.replay_of([(self.header, self.strokes)], str(self))

    def record(self) -> Iterator[str]:
        """The record, line by line."""
        timed = zip(self.strokes, self.elapsed_ns, strict=True)
        return record_lines(self.header, timed, self.outcome, self.seeds, self.after_ns, self._counted)

    def last_lines(self, head: str) -> tuple[str, str]:
        """The lines that complete those which ``Watch.on_line`` was told, ``head`` being the last one's digest."""
        chain = Chain(head)
        end = chain.add(end_entry(len(self.strokes), self.outcome, self.seeds, self.after_ns, self._counted))
        return end, chain.add(unsigned_seal())


def play_game(
    rules: EightBall,
    chairs: Chairs,
    seeds: GameSeeds,
    noise: NoiseModel,
    *,
    breaker: int | None = 0,
    position: Game | None = None,
    players: tuple[str, str] = ("seat 0", "seat 1"),
    number: int = 0,
    games: int | None = None,
    pairs: bool = False,
    score: tuple[float, float] = (0.0, 0.0),
    budget: Budgets | None = None,
    watch: Watch | None = None,
    match: str = "local",
    game: str | None = None,
    timing: Timing | None = None,
) -> PlayedGame:
    """Play one game to its end.

    A chooser that raises, answers nonsense or is refused is asked again; after ``TRIES`` bad answers in a row
    the game is forfeit. One that raises ``Lost`` loses at once.

    Args:
        rules: the referee, on its table.
        chairs: the choosers, by seat.
        seeds: of the game.
        noise: of the game.
        breaker: the seat that breaks this game; None: the one that the seeds draw for the match.
        position: where the match's games begin instead of a break, the seats exchanged in every second one.
        players: names, by seat.
        number, games, score: of the match; as many games as ``number`` needs unless told.
        pairs: whether the match's games share racks by pairs, as in ``MatchSeed.game``.
        budget: of simulated shots, by seat; whoever simulates for a chooser spends it.
        watch: who is told what.
        match, game: their ids in views and record; the game's is ``local-NUMBER`` unless given.
        timing: clocks; None plays without.
    """
    budget = budget or budgets(None)
    terms = MatchTerms(
        match=match,
        games=number + 1 if games is None else games,
        rules=rules,
        noise=noise,
        shared_racks=seeds.shared_racks,
        paired_racks=pairs,
        first_breaker=None if breaker is None else (breaker + number) % 2,
        position=position,
    )
    granted = budget[0].allowed
    header = Header.of(
        terms,
        terms.start(seeds, number),
        seeds,
        game=game or f"local-{number}",
        number=number,
        players=players,
        allowance_ns=timing.allowance_ns if timing else None,
        budget=None if granted is None else GrantedBudget(granted, "by_driver"),
    )
    shown = _terms(header)
    return _GameInPlay(header, chairs, seeds, shown, score, budget, watch or Watch(), timing).play()


def play_match(
    rules: EightBall,
    seat_players: Callable[[int, Budgets], Chairs],
    seed: MatchSeed,
    games: int,
    noise: NoiseModel,
    *,
    position: Game | None = None,
    players: tuple[str, str] = ("seat 0", "seat 1"),
    pairs: bool = False,
    simulations: int | None = None,
    watch: Watch | None = None,
) -> Iterator[PlayedGame]:
    """Play the games of a match one after the other, the break alternating.

    Args:
        seat_players: called with each game's number and its budgets of simulated shots; gives the choosers for that
            game, fresh ones if need be.
        seed: everything random comes from it.
        games: how many, at most 1000.
        pairs: games 0 and 1, 2 and 3, ... have the same racks.
        simulations: shots that each player may simulate in a game; None for any number.
        position: where every game begins instead of a break, the seats exchanged in every second one.
        rules, noise, players, watch: as for ``play_game``.
    """
    score = (0.0, 0.0)
    for number in range(games):
        budget = budgets(simulations)
        played = play_game(
            rules,
            seat_players(number, budget),
            seed.game(number, pairs=pairs),
            noise,
            breaker=None,
            position=position,
            players=players,
            number=number,
            games=games,
            pairs=pairs,
            score=score,
            budget=budget,
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
class _GameInPlay:
    """A game being played."""

    header: Header
    chairs: Chairs
    seeds: GameSeeds
    terms: GameTerms
    score: tuple[float, float]
    budget: Budgets
    watch: Watch
    timing: Timing | None
    strokes: list[Stroke] = field(default_factory=list)
    told: dict[int, StrokeView] = field(default_factory=dict)
    elapsed: list[int | None] = field(default_factory=list)
    clocks: Clocks | None = None
    chain: Chain = field(default_factory=Chain)

    def play(self) -> PlayedGame:
        """Play to the end."""
        game, after_ns = self.header.start, (0, 0)
        self.clocks = Clocks(self.timing.allowance_ns) if self.timing else None
        self._tell(self.header.to_dict)
        while game.outcome is None:
            started = self._now()
            try:
                stroke = self._turn(game, started)
                elapsed = self._now() - started
                self._require_time(game.turn, elapsed)
            except Lost as lost:
                last = self._now() - started
                after_ns = (last, 0) if game.turn == 0 else (0, last)
                game = self.header.terms.rules.end(game, lost.reason, game.turn).game
            else:
                game = self._kept(stroke, elapsed)
        simulated = self.budget[0].used, self.budget[1].used
        return PlayedGame(
            self.header, tuple(self.strokes), game.outcome, self.seeds, tuple(self.elapsed), after_ns, simulated
        )

    def _kept(self, stroke: Stroke, elapsed: int) -> Game:
        """The game after a stroke that stands, its time charged."""
        charged = elapsed if self.clocks else None
        if self.clocks:
            self.clocks = self.clocks.charged(stroke.seat, elapsed)
        number = len(self.strokes)
        self.strokes.append(stroke)
        self.elapsed.append(charged)
        self._tell(lambda: stroke_entry(stroke, number, charged))
        self.watch.on_stroke(stroke)
        return stroke.game

    def _turn(self, game: Game, started: int) -> Stroke:
        """The stroke of the player in turn; raises ``Lost``, after too many bad actions too.

        The clock runs from ``started`` through all tries: a bad answer costs its time.
        """
        terms, spent = self.header.terms, 0
        for attempt in range(1, TRIES + 1):
            try:
                action = self._asked(game.turn, self._view(game, spent))
                return play_stroke(terms.rules, game, action, self.seeds, terms.noise)
            except (BadAnswer, Refused) as error:
                reason = error.__cause__ if isinstance(error.__cause__, Exception) else error
                self.watch.on_refusal(BadAction(game.turn, attempt, reason))
            spent = self._now() - started
            self._require_time(game.turn, spent)
        raise Lost(EndReason.FORFEIT)

    def _asked(self, seat: int, view: View) -> Action:
        """What the player of ``seat`` says, whatever else its code may do."""
        try:
            action = self.chairs[seat](view)
        except Lost:
            raise
        except Exception as error:
            raise BadAnswer("choose", type(error).__name__, "must return an Action") from error
        if not isinstance(action, Action):
            raise BadAnswer("choose", action, "must return an Action")
        return action

    def _now(self) -> int:
        return self.timing.now() if self.timing else 0

    def _require_time(self, seat: int, elapsed: int) -> None:
        """Raise ``Lost`` when the answer came too late; exactly zero left is too late."""
        if self.clocks and self.clocks.charged(seat, elapsed).is_out_of_time(seat):
            raise Lost(EndReason.TIME_OUT)

    def _tell(self, line: Callable[[], dict[str, Any]]) -> None:
        """Hand a line of the record to whoever wants it."""
        if self.watch.on_line:
            self.watch.on_line(self.chain.add(line()))

    def _view(self, game: Game, spent: int) -> View:
        """What the player in turn sees, who has used ``spent`` nanoseconds of this turn."""
        seat = game.turn
        clocks = self.clocks.charged(seat, spent) if self.clocks else None
        return View.of(
            self.terms,
            game,
            seat=seat,
            version=len(self.strokes),
            clocks=(self._clock(clocks, 0, seat), self._clock(clocks, 1, seat)),
            score=self.score,
            strokes_since=partial(self._since_own_last, seat, len(self.strokes)),
        )

    def _since_own_last(self, seat: int, until: int) -> list[StrokeView]:
        """The strokes that a view shows of the first ``until``; each is put into the wire's form once."""
        shown = range(until - len(since_own_last(self.strokes[:until], seat)), until)
        return [self._told(number) for number in shown]

    def _told(self, number: int) -> StrokeView:
        if number not in self.told:
            self.told[number] = StrokeView.of(self.strokes[number], number)
        return self.told[number]

    def _clock(self, clocks: Clocks | None, seat: int, turn: int) -> ClockView:
        left = clocks.remaining_ns(seat) / SECOND_NS if clocks else None
        simulations = self.budget[seat].remaining
        return trusted(ClockView, seconds_left=left, running=seat == turn, simulations_left=simulations)


def _terms(header: Header) -> GameTerms:
    terms = header.terms
    limits, noise = terms.rules.limits, terms.noise
    return GameTerms(
        game=header.game,
        match=terms.match,
        number=header.number,
        games=terms.games,
        players=header.players,
        rules="eight_ball",
        table=terms.rules.table.to_dict(),
        noise=NoiseView.of(noise, noise.told),
        budget=None if header.budget is None else BudgetView.model_validate(header.budget.to_dict()),
        dry_visits_limit=limits.dry_visits,
        replays_limit=limits.replays,
        strokes_limit=limits.strokes,
        commitment=header.commitment,
    )
