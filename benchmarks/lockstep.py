"""Hundreds of games in one process, advancing together: what all players ask of the physics is simulated in one batch.

The players are those of `search`, whose thinking is a generator of questions (`client.agents.search.evaluate`), any
other agent of this package, and a player of an earlier commit in a checkout of its own (`benchmarks.yardstick`):
`search:shots=1000@8336b41`. Games come in pairs of the same racks, the break exchanged, every game with its own noise.
"""

import contextlib
import functools
import time
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

import client
import physics
from benchmarks.checkouts import checkout
from benchmarks.yardstick import Yardstick
from client.agent import Agent, AgentFactory
from client.agents.search import SearchAgent
from client.agents.search.evaluate import Question, Responder, Thinking
from client.agents.search.sight import Sight
from client.agents.search.thinking import GROUPS
from client.agents.search.value import Values
from physics import Table
from protocol import ClockView, GameTerms, NoiseView, View
from referee import Action, Call, EightBall, Game, Phase
from referee.play import MatchSeed, NoiseModel, play_stroke, start_game
from referee.play.seeds import GameSeeds

AT_ONCE = 256
"""Games under way."""
ROWS = 6000
"""Strokes simulated in one batch, more or less: enough to make calls cheap, little enough for the caches."""
NO_CLOCK = (ClockView(seconds_left=None, running=True), ClockView(seconds_left=None, running=False))


@dataclass(frozen=True, slots=True)
class MatchUp:
    """Two players, and the games they play.

    Attributes:
        players: by name; `NAME@COMMIT` is the player of that commit.
        noise: level. table: name. seed: of racks, noise and choices. first, pairs: which pairs of games.
    """

    players: tuple[str, str]
    noise: float
    table: str = "olympiad"
    seed: int = 0
    first: int = 0
    pairs: int = 10


@dataclass(slots=True)
class Turn:
    """A called stroke that was played.

    Attributes:
        seat: who played it. positions: (16, 2) m, the table before, the cue ball placed. group: of the shooter.
        called: whether a ball was called, not a safety. made: whether it fell so, without a foul.
        goes_on: whether the player shoots again. worth: what the player reckoned it to be worth; None if it tells
            none. hand: whether the cue ball was in hand.
    """

    seat: int
    positions: np.ndarray
    group: int
    called: bool
    made: bool
    goes_on: bool
    worth: float | None
    hand: bool = False


@dataclass(slots=True)
class Played:
    """A game that is over.

    Attributes:
        pair: which. breaker, winner: players, not seats of the pair's table; winner None for a draw.
        turns: called strokes. visits: by player, whether it was ever at the table after the break.
        kept: whether the breaker went on after the break. run_out: whether it won without giving up the table.
        strokes, simulated, seconds: by player: strokes but breaks, shots it simulated, processor time if known.
    """

    pair: int
    breaker: int
    winner: int | None = None
    turns: list[Turn] = field(default_factory=list)
    kept: bool = False
    run_out: bool = True
    strokes: list[int] = field(default_factory=lambda: [0, 0])
    simulated: list[int] = field(default_factory=lambda: [0, 0])
    seconds: list[float] = field(default_factory=lambda: [0.0, 0.0])


class Seat:
    """A player of one game."""

    def __init__(self, player: "Player", game: str) -> None:
        self._player, self._game, self._agent = player, game, player.agent()
        self._started = False

    def think(self, view: View) -> Thinking[tuple[Action, float | None, int, float]]:
        """The action; what it is reckoned to be worth, if that is told; shots simulated; processor s, if known."""
        agent = self._agent
        if agent is None:
            assert self._player.yardstick is not None
            action, seconds, simulated = self._player.yardstick.ask(self._game, view)
            return action, None, simulated, seconds
        if not self._started:
            agent.game_started(view)
            self._started = True
        known, before = len(getattr(agent, "thoughts", ())), time.process_time()
        if isinstance(agent, SearchAgent) and agent.counts_shots_alone:
            action = yield from agent.thinking(view)
            seconds = 0.0
        else:  # one that looks at a clock thinks alone: the clock would run on while others do
            action = agent.choose(view)
            seconds = time.process_time() - before
        thoughts = getattr(agent, "thoughts", [])
        if len(thoughts) == known:
            return action, None, 0, seconds
        return action, thoughts[-1].worth, thoughts[-1].simulated, seconds


@dataclass(frozen=True, slots=True)
class Player:
    """One side of a match-up: makes its agents, or asks a process.

    Attributes:
        make: of an agent for each game; None where the process of an earlier commit plays.
    """

    make: AgentFactory | None
    yardstick: Yardstick | None

    def agent(self) -> Agent | None:
        """An agent for a game, or nobody: then the yardstick is asked."""
        return None if self.make is None else self.make()


class Running:
    """A game under way."""

    def __init__(self, rules: EightBall, noise: NoiseModel, seeds: GameSeeds, players: list[Player], of: Played):
        self.played = of
        self._rules, self._noise, self._seeds = rules, noise, seeds
        name = f"pair-{of.pair}-{of.breaker}"
        self._seats = [Seat(player, name) for player in players]
        self._game = start_game(rules, seeds, of.breaker)
        self._terms = _terms(rules, noise, name)
        self._version = 0
        self.question: Question | None = None
        self._thinking = self._play()
        self.advance(None)

    def advance(self, answer: object) -> None:
        """Go on with an answer until something is asked again, or the game is over: `question` is None then."""
        try:
            self.question = next(self._thinking) if answer is None else self._thinking.send(answer)
        except StopIteration:
            self.question = None

    def _play(self) -> Thinking[None]:
        while self._game.outcome is None:
            seat, game = self._game.turn, self._game
            self._version += 1
            view = View.of(
                self._terms, game, seat=seat, version=self._version, clocks=NO_CLOCK, score=(0.0, 0.0), strokes_since=()
            )
            action, worth, simulated, seconds = yield from self._seats[seat].think(view)
            stroke = play_stroke(self._rules, game, action, self._seeds, self._noise, trace=False)
            self._game = stroke.game
            self.played.run_out &= seat == self.played.breaker
            if action.shot is not None and action.call is None:
                self.played.kept = self._game.turn == seat and self._game.phase is Phase.PLAY
            if action.call is not None:
                self._note(game, action, worth, stroke.ruling.made)
                self.played.strokes[seat] += 1
                self.played.simulated[seat] += simulated
                self.played.seconds[seat] += seconds
        self.played.winner = self._game.outcome.winner
        self.played.run_out &= self.played.winner == self.played.breaker

    def _note(self, before: Game, action: Action, worth: float | None, made: bool) -> None:
        """Keep what a called stroke was."""
        positions = before.state.positions.copy()
        if action.cue_ball is not None:
            positions[0] = action.cue_ball
        goes_on = self._game.outcome is None and self._game.turn == before.turn
        group, called = GROUPS[before.group_of(before.turn)], isinstance(action.call, Call)
        if before.phase is Phase.PLAY:
            hand = before.cue_ball_in_hand is not None
            self.played.turns.append(Turn(before.turn, positions, group, called, made, goes_on, worth, hand))


def _terms(rules: EightBall, noise: NoiseModel, name: str) -> GameTerms:
    limits = rules.limits
    return GameTerms(
        game=name,
        match="lockstep",
        number=0,
        games=2,
        players=("first", "second"),
        rules="eight_ball",
        table=rules.table.to_dict(),
        noise=NoiseView(told=True, level=noise.level),
        dry_visits_limit=limits.dry_visits,
        replays_limit=limits.replays,
        strokes_limit=limits.strokes,
        commitment="0" * 64,
    )


def play(match: MatchUp) -> list[Played]:
    """All games of a match-up, in order of pairs."""
    table = Table.named(match.table)
    rules, noise = EightBall(table), NoiseModel(match.noise)
    responder = Responder(table, Values(Sight(table, match.noise), match.noise), physics.simulate_batch)
    with contextlib.ExitStack() as stack:
        players = [stack.enter_context(_player(name, match.seed)) for name in match.players]
        coming = (
            functools.partial(Running, rules, noise, seeds.game(leg, pairs=True), players, Played(pair, leg))
            for pair in range(match.first, match.first + match.pairs)
            for seeds in [MatchSeed.of(1000 * match.seed + pair)]
            for leg in (0, 1)
        )
        played = list(_advance(coming, responder))
    return sorted(played, key=lambda one: (one.pair, one.breaker))


def _advance(coming: Iterator[functools.partial[Running]], responder: Responder) -> Iterator[Played]:
    """Let games advance until all are over; each as it ends."""
    running: list[Running] = []
    while True:
        while len(running) < AT_ONCE and (begin := next(coming, None)) is not None:
            running.append(begin())
        if not running:
            return
        for some in _in_batches(running):
            answers = responder.answers([one.question for one in some if one.question is not None])
            for one, answer in zip(some, answers, strict=True):
                one.advance(answer)
        yield from (one.played for one in running if one.question is None)
        running = [one for one in running if one.question is not None]


def _in_batches(running: list[Running]) -> Iterator[list[Running]]:
    """The games that ask, in groups whose questions make a batch."""
    some: list[Running] = []
    rows = 0
    for one in list(running):
        if one.question is None:
            continue
        some.append(one)
        rows += len(one.question)
        if rows >= ROWS:
            yield some
            some, rows = [], 0
    if some:
        yield some


@contextlib.contextmanager
def _player(name: str, seed: int) -> Iterator[Player]:
    """A player by name."""
    plain, _, commit = name.partition("@")
    if not commit:
        yield Player(client.load(plain, seed), None)
        return
    with checkout(commit) as tree:
        yardstick = Yardstick(tree, plain, seed)
        try:
            yield Player(None, yardstick)
        finally:
            yardstick.end()
