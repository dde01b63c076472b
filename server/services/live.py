"""A game as the database has it: its rows, read into the referee's values and shown as messages."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, Row, select

from physics import Table
from referee.game import Game
from referee.play import Clocks, GameSeeds, MatchSeed, NoiseModel
from referee.play.clock import SECOND_NS
from referee.rules import EightBall
from referee.wire import ClockView, GameTerms, NoiseView, Position, StrokeView, View
from server.errors import Forbidden, NotFound
from server.security.callers import Caller
from server.store.tables import agents, games, matches, moves

RUNNING: Final = "running"
FINISHED: Final = "finished"
ABORTED: Final = "aborted"


@dataclass(frozen=True, slots=True)
class LiveGame:
    """One game with its match.

    Attributes:
        row: of `games`.
        match: of `matches`.
        game: the referee's state.
        players: the agents' names, by seat.
        score: of the match, by seat.
    """

    row: Row[Any]
    match: Row[Any]
    game: Game
    players: tuple[str, str]
    score: tuple[float, float]

    @property
    def id(self) -> str:
        """The game's id."""
        return str(self.row.id)

    @property
    def agents(self) -> tuple[str, str]:
        """The agents' ids, by seat."""
        return self.match.seat_0, self.match.seat_1

    @property
    def is_running(self) -> bool:
        """Whether the game goes on."""
        return bool(self.row.status == RUNNING)

    @property
    def rules(self) -> EightBall:
        """The referee on this match's table."""
        return EightBall(Table.from_dict(self.match.table))

    @property
    def seeds(self) -> GameSeeds:
        """The game's secrets."""
        return MatchSeed.from_hex(self.match.seed).game(self.row.number)

    @property
    def noise(self) -> NoiseModel:
        """The execution noise of the match."""
        return NoiseModel(self.match.noise_level, self.match.noise_told)

    @property
    def clocks(self) -> Clocks:
        """Both clocks as charged so far, the running turn not counted."""
        return Clocks(self.match.allowance, (self.row.used_0, self.row.used_1))

    def seat_of(self, caller: Caller) -> int:
        """The caller's seat; raises `Forbidden` for anybody but the two players."""
        if caller.id not in self.agents:
            raise Forbidden("this is for the game's two players")
        return self.agents.index(caller.id)

    def elapsed(self, now: int) -> int:
        """Nanoseconds that the running turn has taken and that are not charged yet."""
        return max(0, now - int(self.row.clock_from)) if self.is_running else 0

    def time_of_action(self, arrived: int) -> int:
        """Nanoseconds that an action complete at `arrived` is charged.

        On a turn that was never fetched they count from the moment it was there to be fetched: whoever acts knows
        the view from elsewhere, and the wait for the fetch is not free time to think.
        """
        return max(0, arrived - self._thinking_from)

    def is_out_of_time(self, arrived: int) -> bool:
        """Whether an action complete at `arrived` is too late; exactly zero left is."""
        return self.time_of_action(arrived) >= self.clocks.remaining_ns(self.game.turn)

    @property
    def _thinking_from(self) -> int:
        return int(self.row.clock_from if self.row.delivered else self.row.available_at)

    def clock_views(self, now: int) -> tuple[ClockView, ClockView]:
        """Both clocks as they stand now."""
        turn, elapsed = self.game.turn, self.elapsed(now)
        clocks = self.clocks.charged(turn, elapsed)
        return _clock(clocks, 0, turn == 0 and elapsed > 0), _clock(clocks, 1, turn == 1 and elapsed > 0)

    def terms(self) -> GameTerms:
        """What stays the same throughout the game. The rows were validated when they were written."""
        limits = self.rules.limits
        return GameTerms.model_construct(
            game=self.id,
            match=self.match.id,
            number=self.row.number,
            games=self.match.games,
            players=self.players,
            rules=self.match.rules,
            table=self.match.table,
            noise=noise_view(self.match),
            dry_visits_limit=limits.dry_visits,
            replays_limit=limits.replays,
            strokes_limit=limits.strokes,
            commitment=self.row.commitment,
        )

    def view(self, connection: Connection, seat: int | None, now: int) -> View:
        """The game as this seat sees it (None: a spectator)."""
        return View.of(
            self.terms(),
            self.game,
            seat=seat,
            version=self.row.version,
            clocks=self.clock_views(now),
            score=self.score,
            strokes_since=strokes_since(connection, self.id, seat),
        )


def find(connection: Connection, game_id: str) -> LiveGame:
    """The game with this id; raises `NotFound`."""
    row = connection.execute(select(games).where(games.c.id == game_id)).one_or_none()
    if row is None:
        raise NotFound(f"there is no game {game_id}")
    match = connection.execute(select(matches).where(matches.c.id == row.match_id)).one()
    return LiveGame(
        row=row,
        match=match,
        game=Game.from_dict(row.state),
        players=player_names(connection, match),
        score=score_of(connection, match.id),
    )


def player_names(connection: Connection, match: Row[Any]) -> tuple[str, str]:
    """The names of a match's agents, by seat."""
    pair = select(agents.c.id, agents.c.name).where(agents.c.id.in_((match.seat_0, match.seat_1)))
    names = {row.id: row.name for row in connection.execute(pair)}
    return names[match.seat_0], names[match.seat_1]


def position_of(match: Row[Any]) -> Game | None:
    """Where the match's games begin, None when they begin with a break."""
    if match.start is None:
        return None
    rules = EightBall(Table.from_dict(match.table))
    return rules.begin_from(Position.model_validate(match.start).to_game())


def score_of(connection: Connection, match_id: str) -> tuple[float, float]:
    """Games won by seat, half a point each for a drawn one."""
    finished = select(games.c.winner).where(games.c.match_id == match_id, games.c.status == FINISHED)
    score = [0.0, 0.0]
    for winner in connection.scalars(finished):
        for seat in (0, 1):
            score[seat] += 0.5 if winner is None else float(winner == seat)
    return score[0], score[1]


def strokes_since(connection: Connection, game_id: str, seat: int | None) -> Sequence[StrokeView]:
    """The seat's own last stroke and what followed; for a spectator the last stroke."""
    ours = moves.c.game_id == game_id
    last = select(moves.c.number).where(ours).order_by(moves.c.number.desc()).limit(1)
    if seat is not None:
        last = last.where(moves.c.seat == seat)
    first = connection.scalar(last) or 0
    rows = connection.scalars(select(moves.c.stroke).where(ours, moves.c.number >= first).order_by(moves.c.number))
    return tuple(StrokeView.model_validate(stroke) for stroke in rows)


def noise_view(match: Row[Any]) -> NoiseView:
    """What everybody may know of a match's noise: the level is a secret until the end unless it is told."""
    told = match.noise_told or match.status in (FINISHED, ABORTED)
    return NoiseView(told=match.noise_told, level=match.noise_level if told else None)


def _clock(clocks: Clocks, seat: int, running: bool) -> ClockView:
    return ClockView(seconds_left=max(0, clocks.remaining_ns(seat)) / SECOND_NS, running=running)
