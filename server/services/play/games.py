"""The course of a match: games begin, go on with every move, end; the next begins, or the match is over.

Everything here runs in the transaction of whatever caused it.
"""

import logging
import secrets
from dataclasses import dataclass, replace
from typing import Any, Final

from sqlalchemy import Row, bindparam, insert, select, update

from referee.game import EndReason, Game
from referee.play import Charge, GrantedBudget
from referee.record import Chain, Header, end_entry, signed_seal
from server.security import keys
from server.services.matches import match_seeds
from server.services.matches.secrecy import withheld
from server.services.play import agent_messages
from server.services.play.clock import turn_clock
from server.services.play.live_game import ABORTED, FINISHED, RUNNING, LiveGame, find, player_names, score_of
from server.services.runtime.context import Writing
from server.store.database import Overtaken
from server.store.tables import charges, games, matches

log = logging.getLogger("pooliad.server.games")

FIRST_VERSION = 1


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
        **dict.fromkeys(("used_0", "used_1", "lag_0", "lag_1", "grace_0", "grace_1", "simulated_0", "simulated_1"), 0),
        **dict.fromkeys(("present_0", "present_1"), False),
        "started_at": writing.now,
        "header": chain.add(header.to_dict()),
        "head": chain.head,
    }
    turn = turn_clock.mover(match, game) | turn_clock.available(writing, turn_clock.first_turn(writing, match))
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
    turn = _next_turn(writing, live, game, end.charge)
    return _store(writing, live, game, end, turn | {"head": chain.head})


def end_from_outside(
    writing: Writing, live: LiveGame, reason: EndReason, loser: int | None, until: int | None = None
) -> LiveGame:
    """End a running game for a reason that is not on the table (R48).

    The running turn is charged until now, or until a moment in the past when it was over; what follows begins now.
    """
    ruling = live.rules.end(live.game, reason, loser)
    charge = live.charge_until(writing.now if until is None else until)
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
        "deadline": None,
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


def _next_turn(writing: Writing, live: LiveGame, game: Game, charge: Charge) -> dict[str, Any]:
    """The columns of the turn that follows a move."""
    seat, stays = game.turn, game.turn == live.game.turn
    granted = live.granted[seat] + (charge.lag_ns if stays else 0)
    clock = turn_clock.TurnClock(
        remaining=live.clocks.charged(live.game.turn, charge.charged_ns).remaining_ns(seat),
        lag=live.fixture.lag.left_ns(granted),
        grace=0 if stays else writing.context.grace.left_ns(live.graces[seat]),
        present=stays or live.is_present[seat],
    )
    # a mover who stays at the table has the next view in the answer: the clock goes on at once
    turn = turn_clock.delivered(clock, writing.now, writing.now) if stays else turn_clock.available(writing, clock)
    return turn_clock.mover(live.match, game) | turn


def _store(writing: Writing, live: LiveGame, game: Game, end: TurnEnd, turn: dict[str, Any]) -> LiveGame:
    """Compare-and-set on all that was read and may change, and a row in the ledger of the clocks."""
    seat, charge = live.game.turn, end.charge
    values: dict[str, Any] = {
        "state": game.to_dict(),
        "version": live.row.version + 1,
        f"used_{seat}": live.clocks.used_ns[seat] + charge.charged_ns,
        f"lag_{seat}": live.granted[seat] + charge.lag_ns,
        f"grace_{seat}": live.graces[seat] + charge.grace_ns,
        f"present_{seat}": live.is_present[seat] or end.move is not None,
    } | turn
    seen = {f"seen_{name}": getattr(live.row, name) for name in _COMPARED}
    if writing.connection.execute(_IF_UNCHANGED, values | seen).rowcount != 1:
        raise MoveConflict
    row = {"game_id": live.id, "seat": seat, "move": end.move, "created_at": writing.now}
    parts = {"measured": charge.measured_ns, "lag": charge.lag_ns, "grace": charge.grace_ns}
    writing.connection.execute(_CHARGE, row | parts)
    return replace(live, row=replace(live.row, **values), game=game)


_CHARGE: Final = insert(charges)
_CLOCKED: Final = ("delivered", "available_at", "clock_from", "carried", "carried_grace")
_COMPARED: Final = ("id", "version", *_CLOCKED, "present_0", "present_1")
"""Columns by which a game is known to be as it was read: the rest changes with its version alone, but for the counters
of simulated shots, which are added to and not written: whoever simulates bounces nobody's stroke."""
_IF_UNCHANGED: Final = update(games).where(*(games.c[name] == bindparam(f"seen_{name}") for name in _COMPARED))
