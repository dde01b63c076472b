"""Matches in one process, without server and clock: for trying an agent out, and for measuring it."""

import secrets
import traceback
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final

from client import notebook
from client.agent import AgentFactory
from client.agents.registry import Player, factory_of, titles
from client.errors import AgentFailed, AgentUnstartable
from client.local_game import BadAction, Chairs, PlayedGame, Watch, play_match, points_of
from client.session import AgentSession
from physics import Table
from protocol import GameOver, GameTerms, OutcomeView, View
from referee import EightBall, Game, Phase
from referee.play import LINKS, Budgets, MatchSeed, NoiseModel, Refused, Stroke

SAME_EXCEPTION: Final = 3
"""Times an agent may raise the same exception; the third shows that no other try will help."""


@dataclass(frozen=True, slots=True)
class LocalMatch:
    """A finished match.

    Attributes:
        players: names, by seat.
        games: each with its strokes, its outcome and its record.
        score: games won, by seat; half a point each for a drawn one.
        seed: of the match; the same seed repeats it.
    """

    players: tuple[str, str]
    games: tuple[PlayedGame, ...]
    score: tuple[float, float]
    seed: int

    def __str__(self) -> str:
        """Who played and how it ended."""
        (one, other), (first, second) = self.players, self.score
        return f"{one} {first:g} : {second:g} {other}, seed {self.seed}"

    def __repr__(self) -> str:
        return f"<LocalMatch {self}>"

    def _repr_html_(self) -> str:
        return notebook.replay_of([(game.header, game.strokes) for game in self.games], str(self))

    @property
    def winner(self) -> str | None:
        """The name of the player with more points; None for a draw."""
        first, second = self.score
        return None if first == second else self.players[0 if first > second else 1]


def play(
    agent_a: Player,
    agent_b: Player,
    *,
    games: int = 1,
    seed: int | None = None,
    noise: float | NoiseModel = 1.0,
    table: Table | None = None,
    simulations: int | None = None,
    start: Game | None = None,
    on_stroke: Callable[[Stroke], Any] | None = None,
    strict: bool = True,
) -> LocalMatch:
    """Play a match of 8-ball between two agents.

    What an agent does wrong is logged, and it is asked again; after twenty bad actions in a row it forfeits the game.

    Args:
        agent_a, agent_b: the players of seat 0 and seat 1.
        games: how many, 1 to 1000; the break alternates.
        seed: repeats racks, first breaker, noise and the choices of shipped agents; drawn unless given.
        noise: level, 0 to 5, 1 is the Olympiad's; or a `NoiseModel` with standard deviations of its own.
        table: any `physics.Table`; the Olympiad's unless given.
        simulations: shots that each agent may simulate in a game with its `simulator`; any number unless given.
        start: where every game begins instead of a break, e.g. `view.to_game()`; the seats are exchanged in
            every second game.
        on_stroke: called after every stroke and decision.
        strict: end the match when an agent has raised the same exception, of one type at one line, three times.

    Raises:
        client.errors.AgentNotFound: a name leads nowhere.
        client.errors.AgentUnstartable: an agent cannot be made or its command cannot be started.
        client.errors.AgentFailed: an agent has raised the same exception three times; the cause is the last of them,
            with the agent's own traceback.
        ValueError: a number of games, a seed, a level of noise or a number of simulations that is none, a
            start that cannot be played on from (`referee.InvalidGame`).
    """
    if isinstance(games, bool) or not isinstance(games, int) or not 1 <= games <= LINKS:
        raise ValueError(f"games = {games!r}: must be an integer in [1, {LINKS}]")
    seed = secrets.randbelow(2**32) if seed is None else seed
    players = titles(_name(agent_a), _name(agent_b))
    sides = _Sides((factory_of(agent_a, seed), factory_of(agent_b, seed)), players, strict)
    watch = Watch(on_stroke=on_stroke or (lambda stroke: None), on_refusal=sides.refused)
    rules, model = EightBall(table or Table.olympiad()), NoiseModel.of(noise)
    match = play_match(
        rules,
        sides.seat,
        MatchSeed.of(seed),
        games,
        model,
        position=None if start is None else rules.begin_from(start),
        players=players,
        simulations=simulations,
        watch=watch,
    )
    played = tuple(sides.finished(game) for game in match)
    return LocalMatch(players, played, sides.score, seed)


class _Sides:
    """Two players, a fresh instance of each for every game, the score, and what their code raised."""

    def __init__(self, factories: tuple[AgentFactory, AgentFactory], players: tuple[str, str], strict: bool) -> None:
        self._sessions = AgentSession(factories[0]), AgentSession(factories[1])
        self._players = players
        self._strict = strict
        self._raised: Counter[tuple[object, ...]] = Counter()
        self.score = (0.0, 0.0)

    def seat(self, _number: int, budget: Budgets) -> Chairs:
        """The choosers for the next game, each simulating on its budget."""
        for session, own in zip(self._sessions, budget, strict=True):
            session.begin(own)
            session.make()
        return self._sessions[0].ask, self._sessions[1].ask

    def refused(self, bad: BadAction) -> None:
        """Tell a player why its action was not accepted; end the match over an exception that comes again."""
        if isinstance(bad.reason, Refused):
            self._sessions[bad.seat].refused(str(bad.reason))
        elif isinstance(bad.reason, AgentUnstartable):
            raise bad.reason
        elif self._strict:
            self._count(bad.seat, bad.reason)

    def _count(self, seat: int, error: Exception) -> None:
        """Raise when the player has raised this exception, of one type at one line, too often."""
        lines = [(frame.f_code.co_filename, number) for frame, number in traceback.walk_tb(error.__traceback__)]
        this = seat, type(error), lines[-1:] and lines[-1]
        self._raised[this] += 1
        if self._raised[this] == SAME_EXCEPTION:
            words = f"{type(error).__name__}: {error}"
            raise AgentFailed(
                f"{self._players[seat]} (seat {seat}) raised the same exception {SAME_EXCEPTION} times, the last one "
                f"{words}; with strict=False the match goes on"
            ) from error

    def finished(self, game: PlayedGame) -> PlayedGame:
        """Count a game, and tell both players of it."""
        first, second = points_of(game.outcome)
        self.score = self.score[0] + first, self.score[1] + second
        for seat, session in enumerate(self._sessions):
            if session.last is not None:
                session.over(over_message(game, seat, session.last, self.score))
        return game


def _name(player: Player) -> str:
    """What the player goes by."""
    return player if isinstance(player, str) else getattr(player, "__name__", "agent")


def over_message(game: PlayedGame, seat: int, last: View, score: tuple[float, float]) -> GameOver:
    """What a server would tell the player of this seat at the end of the game; ``last`` is the view it saw last.

    Not the seed of noise that is not told: more games may follow with the same level.
    """
    header, outcome, strokes = game.header, game.outcome, game.strokes
    terms = GameTerms.model_construct(**{name: getattr(last, name) for name in GameTerms.model_fields})
    after = strokes[-1].game if strokes else header.start
    view = View.of(
        terms, replace(after, phase=Phase.OVER, outcome=outcome), seat=seat, version=len(strokes),
        clocks=last.clocks, score=score,
    )  # fmt: skip
    return GameOver(
        game=header.game,
        match=header.terms.match,
        number=header.number,
        seat=seat,
        outcome=OutcomeView.of(outcome),
        won=None if outcome.winner is None else outcome.winner == seat,
        score=score,
        noise_seed=game.seeds.noise_seed.hex() if header.terms.noise.told else None,
        record="",
        view=view,
    )
