"""The course of a match: games begin, go on with every move, end; the next begins, or the match is over.

Everything here runs in the transaction of whatever caused it.
"""

import logging
import secrets
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Final

from sqlalchemy import Row, bindparam, insert, select, update

from referee.game import EndReason, Game
from referee.play import Charge, GrantedBudget
from referee.play.clock import GameClock
from referee.record import Chain, Header, end_entry, signed_seal
from server.security import keys
from server.services.matches import match_seeds
from server.services.matches.secrecy import withheld
from server.services.play import agent_messages
from server.services.play.clock import columns, ledger
from server.services.play.live_game import (
    ABORTED,
    FINISHED,
    FIRST_VERSION,
    RUNNING,
    LiveGame,
    find,
    player_names,
    score_of,
)
from server.services.runtime.context import Writing
from server.store.outages import Overtaken
from server.store.prepared import Prepared
from server.store.tables import games, matches

log = logging.getLogger("pooliad.server.games")


def begin(writing: Writing, match: Row[Any], number: int) -> None:
    """Put the balls of the match's next game where it begins."""
    terms, seeds = match_seeds.terms_of(match), match_seeds.game_seeds(match, number)
    game = terms.start(seeds, number)
    chain = Chain()
    header = Header.of(
        terms,
        game,
        seeds,
        game=f"game_{secrets.token_hex(8)}",
        number=number,
        players=player_names(writing.connection, match),
        allowance_ns=match.allowance,
        budget=None if match.simulations is None else GrantedBudget(match.simulations, "by_honour"),
    )
    row = {
        "id": header.game,
        "match_id": match.id,
        "number": number,
        "noise_secret": seeds.noise.hex(),
        "rack_secret": seeds.racks.hex(),
        "noise_seed": seeds.noise_seed.hex(),
        "commitment": header.commitment,
        "breaker": game.breaker,
        "state": game.to_dict(),
        "version": FIRST_VERSION,
        "status": RUNNING,
        "simulated_0": 0,
        "simulated_1": 0,
        "started_at": writing.now,
        "header": chain.add(header.to_dict()),
        "head": chain.head,
    }
    turn = _turn(writing, match, game, _offered(writing, columns.fresh(match), game.turn))
    writing.connection.execute(insert(games).values(row | turn))


@dataclass(frozen=True, slots=True)
class TurnEnd:
    """How a turn ended.

    Attributes:
        charge: what it costs its player.
        move: the number of the move that ended it; None when it ended from outside.
    """

    charge: Charge
    move: int | None = None


class MoveConflict(Overtaken):
    """The game, or its running clock, is not any more as it was read."""


def next_move(live: LiveGame) -> int:
    """The number that the game's next move gets: every move, and nothing else before the end, makes a new version."""
    return live.row.version - FIRST_VERSION


def advance(writing: Writing, live: LiveGame, game: Game, end: TurnEnd, chain: Chain) -> LiveGame:
    """Store what a move made of a game, and what follows from it.

    `chain` is that of the record's lines, the move's among them.

    Raises `Moved` when somebody else was first.
    """
    if game.is_over:
        return _finish(writing, live, game, end, chain)
    clock = live.clock.ended(end.charge, moved=True)
    # a mover who stays at the table has the next view in the answer: the clock goes on at once
    stays = game.turn == live.game.turn
    clock = clock.handed(game.turn, writing.now) if stays else _offered(writing, clock, game.turn)
    return _store(writing, live, game, end, _turn(writing, live.match, game, clock) | {"head": chain.head})


def end_from_outside(
    writing: Writing, live: LiveGame, reason: EndReason, loser: int | None, until: int | None = None
) -> LiveGame:
    """End a running game for a reason that is not on the table (R48).

    The running turn is charged until now, or until a moment in the past when it was over; what follows begins now.
    """
    ruling = live.rules.end(live.game, reason, loser)
    charge = live.clock.charge(writing.now if until is None else until)
    return _finish(writing, live, ruling.game, TurnEnd(charge), Chain(live.row.head))


def abort_running(writing: Writing, match: Row[Any]) -> None:
    """Abort a match's running game, if there is one, and tell both players."""
    running = select(games.c.id).where(games.c.match_id == match.id, games.c.status == RUNNING)
    for game_id in writing.connection.scalars(running).all():
        end_from_outside(writing, find(writing.connection, game_id), EndReason.ABORTED, None)


def _finish(writing: Writing, live: LiveGame, game: Game, end: TurnEnd, chain: Chain) -> LiveGame:
    """The game is over: its result, the end of its record, the news to both players, and what comes next."""
    outcome = game.outcome
    assert outcome is not None
    aborted = outcome.reason is EndReason.ABORTED
    entries, after_last_move = next_move(live), [0, 0]
    if end.move is not None:
        entries += 1
    else:
        after_last_move[live.game.turn] = end.charge.charged_ns
    simulated = None if live.match.simulations is None else (live.row.simulated_0, live.row.simulated_1)
    ending = chain.add(end_entry(entries, outcome, live.seeds, after_last_move, simulated))
    key, signed_at = keys.sealing(writing.connection, writing.now)
    seal = signed_seal(key, chain.head, signed_at)
    values = {
        "status": ABORTED if aborted else FINISHED,
        "winner": outcome.winner,
        "mover": None,
        **columns.written(live.clock.ended(end.charge, moved=end.move is not None), writing.context.settings),
        "ended_at": writing.now,
        "ending": ending,
        "seal": chain.add(seal),
        "head": chain.head,
    }
    live = _store(writing, live, game, end, values)
    over = aborted or live.row.number + 1 >= live.match.games
    until = withheld(writing.connection, live.match, over=over)
    score = score_of(writing.connection, live.match.id)
    live = replace(live, fixture=replace(live.fixture, score=score, withheld=until))
    agent_messages.game_over(writing.connection, live, writing.now)
    writing.context.metrics.games_ended.labels(outcome.reason.value).inc()
    log.info("game over", extra={"fields": {"game": live.id} | outcome.to_dict()})
    if not aborted:
        _go_on(writing, live)
    return live


def _go_on(writing: Writing, live: LiveGame) -> None:
    """The next game of the match, or its end."""
    if live.row.number + 1 < live.match.games:
        begin(writing, live.match, live.row.number + 1)
        return
    this = matches.c.id == live.match.id
    writing.connection.execute(update(matches).where(this).values(status=FINISHED, ended_at=writing.now))
    agent_messages.match_over(writing.connection, live.match, FINISHED)
    writing.context.match_over(writing, live.match.id)


def _offered(writing: Writing, clock: GameClock, seat: int) -> GameClock:
    return clock.offered(seat, writing.now, columns.fetch_grace(writing.context.settings))


def _turn(writing: Writing, match: Row[Any], game: Game, clock: GameClock) -> dict[str, Any]:
    """The columns of a turn: whose it is, and the clock."""
    return {"mover": (match.seat_0, match.seat_1)[game.turn]} | columns.written(clock, writing.context.settings)


def _store(writing: Writing, live: LiveGame, game: Game, end: TurnEnd, turn: dict[str, Any]) -> LiveGame:
    """Compare-and-set on all that was read and may change, and a row in the ledger of the clocks."""
    values: dict[str, Any] = {"state": game.to_dict(), "version": live.row.version + 1} | turn
    seen = {f"seen_{name}": getattr(live.row, name) for name in _COMPARED}
    if _of_columns(frozenset(values)).run(writing.connection, values | seen) != 1:
        raise MoveConflict
    ledger.enter(writing, live, end.move, end.charge)
    return replace(live, row=replace(live.row, **values), game=game)


_COMPARED: Final = ("id", "version", *columns.COMPARED)
"""Columns by which a game is known to be as it was read: the rest changes with its version alone, but for the counters
of simulated shots, which are added to and not written: whoever simulates bounces nobody's stroke."""
_IF_UNCHANGED: Final = update(games).where(*(games.c[name] == bindparam(f"seen_{name}") for name in _COMPARED))


@cache
def _of_columns(names: frozenset[str]) -> Prepared:
    """The statement that stores these columns: those of a game that goes on, or of one that ends."""
    return Prepared(_IF_UNCHANGED)
