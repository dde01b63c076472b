"""Matches in one process, without server and clock: for trying an agent out, and for measuring it."""

import secrets
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from client.agent import AgentFactory
from client.agents.registry import Player, factory_of, titles
from client.local_game import BadAction, PlayedGame, Watch, play_match, points_of
from client.players import Instance, log
from physics import Table
from protocol import GameOver, GameTerms, OutcomeView, View
from referee import Action, EightBall, Game, Phase, SimulationBudget
from referee.play import LINKS, Budgets, MatchSeed, NoiseModel, Refused, Stroke


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
    noise: float = 1.0,
    table: Table | None = None,
    simulations: int | None = None,
    start: Game | None = None,
    on_stroke: Callable[[Stroke], Any] | None = None,
) -> LocalMatch:
    """Play a match of 8-ball between two agents.

    What an agent does wrong is logged; after twenty bad actions in a row it forfeits the game.

    Args:
        agent_a, agent_b: the players of seat 0 and seat 1.
        games: how many, 1 to 1000; the break alternates.
        seed: repeats racks, first breaker, noise and the choices of shipped agents; drawn unless given.
        noise: level, 0 to 5; 1 is the Olympiad's.
        table: the Olympiad's unless given.
        simulations: shots that each agent may simulate in a game with its `simulator`; any number unless given.
        start: where every game begins instead of a break, e.g. `view.to_game()`; the seats are exchanged in
            every second game.
        on_stroke: called after every stroke and decision.

    Raises:
        client.errors.AgentNotFound: a name leads nowhere.
        ValueError: a number of games, a seed, a level of noise or a number of simulations that is none, a
            start that cannot be played on from (`referee.InvalidGame`).
    """
    if isinstance(games, bool) or not isinstance(games, int) or not 1 <= games <= LINKS:
        raise ValueError(f"games = {games!r}: must be an integer in [1, {LINKS}]")
    seed = secrets.randbelow(2**32) if seed is None else seed
    hall = _Hall((factory_of(agent_a, seed), factory_of(agent_b, seed)))
    players = titles(_name(agent_a), _name(agent_b))
    watch = Watch(on_stroke=on_stroke or _ignore, on_refusal=hall.refused)
    rules, model = EightBall(table or Table.olympiad()), NoiseModel(noise)
    match = play_match(
        rules,
        hall.seat,
        MatchSeed.of(seed),
        games,
        model,
        position=None if start is None else rules.begin_from(start),
        players=players,
        simulations=simulations,
        watch=watch,
    )
    played = tuple(hall.finished(game) for game in match)
    return LocalMatch(players, played, hall.score, seed)


class _Chair:
    """One player in one game."""

    def __init__(self, seat: int, factory: AgentFactory, budget: SimulationBudget) -> None:
        self._seat = seat
        self._instance = Instance(factory, budget)

    def __call__(self, view: View) -> Action:
        """The agent's answer; whatever it raises goes to the driver."""
        return self._instance.choose(view)

    def refused(self, bad: BadAction) -> None:
        """Tell the agent why its action was not accepted; what it raised itself it knows."""
        if not isinstance(bad.reason, Refused):
            return
        try:
            self._instance.refused(str(bad.reason))
        except Exception:
            log.exception("refused raised")

    def finish(self, game: PlayedGame, score: tuple[float, float]) -> None:
        """Tell an agent that has been at the table how the game ended."""
        if self._instance.last is None:
            return
        try:
            self._instance.game_over(over_message(game, self._seat, self._instance.last, score))
        except Exception:
            log.exception("game %s: game_over raised", game.header.game)


class _Hall:
    """Two players, a pair of fresh instances for every game, and the score."""

    def __init__(self, factories: tuple[AgentFactory, AgentFactory]) -> None:
        self._factories = factories
        self.score = (0.0, 0.0)

    def seat(self, _number: int, budget: Budgets) -> tuple[_Chair, _Chair]:
        """The choosers for the next game, each simulating on its budget."""
        self._chairs = _Chair(0, self._factories[0], budget[0]), _Chair(1, self._factories[1], budget[1])
        return self._chairs

    def refused(self, bad: BadAction) -> None:
        """Log a bad action, and tell the player."""
        _log_bad_action(bad)
        self._chairs[bad.seat].refused(bad)

    def finished(self, game: PlayedGame) -> PlayedGame:
        """Count a game, and tell both players of it."""
        first, second = points_of(game.outcome)
        self.score = self.score[0] + first, self.score[1] + second
        for chair in self._chairs:
            chair.finish(game, self.score)
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


def _ignore(_stroke: Stroke) -> None:
    """For nobody who watches."""


def _log_bad_action(bad: BadAction) -> None:
    """Say in the log what an agent did wrong, with its traceback if it raised."""
    log.error("seat %d, bad action %d in a row: %s", bad.seat, bad.attempt, bad.reason, exc_info=bad.reason)
