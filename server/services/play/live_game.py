"""A game as the database has it: its rows, read into the referee's values and shown as messages."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, bindparam, func, select

from physics import Table
from protocol import BudgetView, ClockView, GameTerms, NoiseView, StrokeView, View
from protocol.strokes import since_own_last
from referee.game import Game
from referee.play import GameSeeds, NoiseModel
from referee.play.clock import GameClock
from referee.rules import EightBall
from server.errors import Forbidden, NotFound
from server.security.callers import Caller
from server.services.matches import match_seeds
from server.services.matches.secrecy import Holder, withheld
from server.services.play import stored_strokes
from server.services.play.clock import columns
from server.services.play.long_strokes import MOST_EVENTS
from server.store import locks
from server.store.prepared import Prepared
from server.store.rows import GameRow
from server.store.tables import agents, games, matches, moves

RUNNING: Final = "running"
FINISHED: Final = "finished"
ABORTED: Final = "aborted"
FIRST_VERSION: Final = 1
MOST_RECENT: Final = 32
"""Strokes of a game that are remembered: more than a visit has, but for the longest."""


@dataclass(frozen=True)
class Fixture:
    """What stays as it is while a game runs: its match.

    Attributes:
        match: of `matches`.
        players: the agents' names, by seat.
        score: of the match, by seat.
        withheld: until whose end its noise is kept back.
        game_terms: what views say of them, by game, once it has been asked for.
    """

    match: Row[Any]
    players: tuple[str, str]
    score: tuple[float, float]
    withheld: Holder | None
    game_terms: dict[str, GameTerms] = field(default_factory=dict, init=False, compare=False, repr=False)

    @cached_property
    def rules(self) -> EightBall:
        """The referee on this match's table."""
        return EightBall(Table.from_dict(self.match.table))

    @cached_property
    def ordinary_rules(self) -> EightBall:
        """The same, with strokes that end before they are long."""
        rules = self.rules
        if rules.limits.events <= MOST_EVENTS:
            return rules
        return replace(rules, limits=replace(rules.limits, events=MOST_EVENTS))

    @cached_property
    def noise(self) -> NoiseModel:
        """The execution noise of the match."""
        return match_seeds.noise_of(self.match)


@dataclass(frozen=True, slots=True)
class LiveGame:
    """One game with its match.

    Attributes:
        row: of `games`.
        fixture: its match.
        game: the referee's state.
        recent: its latest strokes without a gap, as many as are known here.
    """

    row: GameRow
    fixture: Fixture
    game: Game
    recent: tuple[StrokeView, ...] = ()
    _clock: GameClock | None = field(default=None, init=False, repr=False, compare=False)

    @property
    def id(self) -> str:
        """The game's id."""
        return self.row.id

    @property
    def match(self) -> Row[Any]:
        """The row of its match."""
        return self.fixture.match

    @property
    def agents(self) -> tuple[str, str]:
        """The agents' ids, by seat."""
        return self.match.seat_0, self.match.seat_1

    @property
    def is_running(self) -> bool:
        """Whether the game goes on."""
        return self.row.status == RUNNING

    @property
    def rules(self) -> EightBall:
        """The referee on this match's table."""
        return self.fixture.rules

    @property
    def seeds(self) -> GameSeeds:
        """The game's secrets."""
        return match_seeds.kept_seeds(self.match, self.row)

    @property
    def clock(self) -> GameClock:
        """Both players' clocks, and the turn that runs."""
        if self._clock is None:  # a stroke asks for it four times
            clock = columns.read(self.row, self.match, self.game.turn if self.is_running else None)
            object.__setattr__(self, "_clock", clock)
            return clock
        return self._clock

    def seat_of(self, caller: Caller) -> int:
        """The caller's seat; raises `Forbidden` for anybody but the two players."""
        if caller.id not in self.agents:
            raise Forbidden("this is for the game's two players")
        return self.agents.index(caller.id)

    def clock_views(self, now: int) -> tuple[ClockView, ClockView]:
        """Both clocks as they stand now."""
        return columns.views(self.clock, now, (self.simulations_left(0), self.simulations_left(1)))

    def simulations_left(self, seat: int) -> int | None:
        """Shots that this seat may still simulate; None for any number."""
        simulated = (self.row.simulated_0, self.row.simulated_1)[seat]
        return None if self.match.simulations is None else max(0, self.match.simulations - simulated)

    def terms(self) -> GameTerms:
        """What stays the same throughout the game, put together once."""
        known = self.fixture.game_terms
        if self.id not in known:
            known[self.id] = self._terms()
        return known[self.id]

    def _terms(self) -> GameTerms:
        """The rows were validated when they were written."""
        limits = self.rules.limits
        return GameTerms.model_construct(
            game=self.id,
            match=self.match.id,
            number=self.row.number,
            games=self.match.games,
            players=self.fixture.players,
            rules=self.match.rules,
            table=self.match.table,
            noise=noise_view(self.match, self.fixture.withheld),
            budget=budget_view(self.match),
            dry_visits_limit=limits.dry_visits,
            replays_limit=limits.replays,
            strokes_limit=limits.strokes,
            commitment=self.row.commitment,
        )

    def with_stroke(self, stroke: StrokeView) -> "LiveGame":
        """The same with its latest stroke known; those that no view will show again are forgotten."""
        strokes = (*self.recent, stroke)
        shown = max((since_own_last(strokes, seat) for seat in (0, 1)), key=len)
        return replace(self, recent=shown[-MOST_RECENT:])

    def view(self, connection: Connection, seat: int | None, now: int) -> View:
        """The game as this seat sees it (None: a spectator)."""
        strokes = since_own_last(self.recent, seat) if self._knows_strokes_since(seat) else None
        return self.view_since(strokes_since(connection, self.id, seat) if strokes is None else strokes, seat, now)

    def _knows_strokes_since(self, seat: int | None) -> bool:
        """Whether the strokes that a seat is shown are among the recent ones."""
        if len(self.recent) == self.row.version - FIRST_VERSION:
            return True
        return bool(self.recent) if seat is None else any(stroke.seat == seat for stroke in self.recent)

    def view_since(self, strokes: Sequence[StrokeView], seat: int | None, now: int) -> View:
        """The same, with the strokes that it is to show."""
        return View.of(
            self.terms(),
            self.game,
            seat=seat,
            version=self.row.version,
            clocks=self.clock_views(now),
            score=self.fixture.score,
            strokes_since=strokes,
        )


_GAME: Final = Prepared(select(games).where(games.c.id == bindparam("id")))
_CLOCK: Final = Prepared(
    select(*(games.c[name] for name in columns.COLUMNS), games.c.simulated_0, games.c.simulated_1).where(
        games.c.id == bindparam("id"), games.c.version == bindparam("version")
    )
)
_FIRST, _SECOND = agents.alias(), agents.alias()
_MATCH: Final = Prepared(
    select(matches, _FIRST.c.name.label("name_0"), _SECOND.c.name.label("name_1"))
    .join(_FIRST, _FIRST.c.id == matches.c.seat_0)
    .join(_SECOND, _SECOND.c.id == matches.c.seat_1)
    .where(matches.c.id == bindparam("id"))
)


def find(connection: Connection, game_id: str) -> LiveGame:
    """The game with this id; raises `NotFound`."""
    return read(connection, find_row(connection, game_id))


def find_row(connection: Connection, game_id: str) -> GameRow:
    """The row of the game with this id; raises `NotFound`."""
    row = _GAME.first(connection, id=game_id)
    if row is None:
        raise NotFound(f"there is no game {game_id}")
    return GameRow.of(row)


def clock_of(connection: Connection, known: GameRow) -> GameRow | None:
    """A game's row with what may change while its version stays, read anew; None when it has another version."""
    row = _CLOCK.first(connection, id=known.id, version=known.version)
    return None if row is None else replace(known, **row._asdict())


def read(connection: Connection, row: GameRow) -> LiveGame:
    """The game whose row this is."""
    match = _MATCH.first(connection, id=row.match_id)
    score = score_of(connection, match.id) if row.number else (0.0, 0.0)
    fixture = Fixture(match, (match.name_0, match.name_1), score, withheld(connection, match))
    return LiveGame(row, fixture, Game.from_dict(row.state))


def hold(connection: Connection, game_id: str) -> LiveGame:
    """The same, to be written: nobody else writes the match until the transaction ends."""
    locks.hold_match_of(connection, game_id)
    return find(connection, game_id)


def find_match(connection: Connection, match_id: str) -> Row[Any]:
    """The match with this id; raises `NotFound`."""
    row = connection.execute(select(matches).where(matches.c.id == match_id)).one_or_none()
    if row is None:
        raise NotFound(f"there is no match {match_id}")
    return row


def hold_match(connection: Connection, match_id: str) -> Row[Any]:
    """The same, to be written by this transaction alone."""
    locks.hold_match(connection, match_id)
    return find_match(connection, match_id)


def player_names(connection: Connection, match: Row[Any]) -> tuple[str, str]:
    """The names of a match's agents, by seat."""
    pair = select(agents.c.id, agents.c.name).where(agents.c.id.in_((match.seat_0, match.seat_1)))
    names = {row.id: row.name for row in connection.execute(pair)}
    return names[match.seat_0], names[match.seat_1]


def score_of(connection: Connection, match_id: str) -> tuple[float, float]:
    """Games won by seat, half a point each for a drawn one."""
    finished = select(games.c.winner).where(games.c.match_id == match_id, games.c.status == FINISHED)
    return points(connection.scalars(finished))


def points(winners: Iterable[int | None]) -> tuple[float, float]:
    """The score that these winners of games make, None for a draw."""
    score = [0.0, 0.0]
    for winner in winners:
        for seat in (0, 1):
            score[seat] += 0.5 if winner is None else float(winner == seat)
    return score[0], score[1]


def strokes_since(connection: Connection, game_id: str, seat: int | None) -> Sequence[StrokeView]:
    """The seat's own last stroke and what followed; for a spectator the last stroke."""
    rows = (
        _SINCE_LAST.all(connection, game=game_id)
        if seat is None
        else _SINCE_OWN.all(connection, game=game_id, seat=seat)
    )
    return tuple(stored_strokes.view(row) for row in rows)


def _strokes_since(last: Select[Any]) -> Prepared:
    first = func.coalesce(last.order_by(moves.c.number.desc()).limit(1).scalar_subquery(), 0)
    since = select(*stored_strokes.SUMMED).where(moves.c.game_id == bindparam("game"), moves.c.number >= first)
    return Prepared(since.order_by(moves.c.number))


_LAST: Final = select(moves.c.number).where(moves.c.game_id == bindparam("game"))
_SINCE_LAST: Final = _strokes_since(_LAST)
_SINCE_OWN: Final = _strokes_since(_LAST.where(moves.c.seat == bindparam("seat")))


def noise_view(match: Row[Any], until: Holder | None) -> NoiseView:
    """What everybody may know of a match's noise: no level while it is `withheld`."""
    return NoiseView.of(match_seeds.noise_of(match), until is None)


def budget_view(match: Row[Any]) -> BudgetView | None:
    """The match's budget of simulated shots."""
    if match.simulations is None:
        return None
    return BudgetView(simulations=match.simulations, counted="by_honour")
