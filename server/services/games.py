"""The course of a match: games begin, go on with every move, end; the next begins, or the match is over.

Everything here runs in the transaction of whatever caused it.
"""

import secrets
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from sqlalchemy import Connection, Row, func, insert, select, update

from physics import Table
from referee.game import EndReason, Game
from referee.play import GameSeeds, MatchSeed, NoiseModel, begin_game
from referee.record import Header, canonical, end_entry
from referee.rules import EightBall
from server.errors import StaleVersion
from server.services import notices
from server.services.context import Writing
from server.services.live import ABORTED, FINISHED, RUNNING, LiveGame, find, player_names, position_of, score_of
from server.store.tables import games, matches, moves

FIRST_VERSION = 1


def begin(writing: Writing, match: Row[Any], number: int) -> None:
    """Rack the match's next game; its commitment is public from here on."""
    seed = MatchSeed.from_hex(match.seed)
    seeds = seed.game(number)
    game = begin_game(EightBall(Table.from_dict(match.table)), seed, number, position_of(match))
    header = _header(writing.connection, match, number, seeds, game)
    row = {
        "id": header.game,
        "match_id": match.id,
        "number": number,
        "noise_seed": seeds.noise.hex(),
        "commitment": seeds.commitment,
        "breaker": game.breaker,
        "state": game.to_dict(),
        "version": FIRST_VERSION,
        "status": RUNNING,
        "used_0": 0,
        "used_1": 0,
        "started_at": writing.now,
        "header": canonical(header.to_dict()),
    }
    writing.connection.execute(insert(games).values(row | _turn(writing, match, game, match.allowance)))


def advance(writing: Writing, live: LiveGame, game: Game, elapsed: int) -> LiveGame:
    """Store what a move made of a game, `elapsed` ns off the mover's clock, and what follows from it.

    Raises `StaleVersion` when somebody else was first.
    """
    if game.is_over:
        return _finish(writing, live, game, elapsed, (0, 0))
    mover = live.game.turn
    remaining = live.clocks.charged(mover, elapsed).remaining_ns(game.turn)
    # a mover who stays at the table has the next view in the answer: the clock goes on at once
    turn = _turn(writing, live.match, game, remaining, delivered=game.turn == mover)
    return _store(writing, live, game, elapsed, turn)


def end_from_outside(writing: Writing, live: LiveGame, reason: EndReason, loser: int | None) -> LiveGame:
    """End a running game for a reason that is not on the table (R48); the running turn is charged."""
    ruling = live.rules.end(live.game, reason, loser)
    elapsed, turn = live.elapsed(writing.now), live.game.turn
    last = live.row.carried + elapsed
    return _finish(writing, live, ruling.game, elapsed, (last, 0) if turn == 0 else (0, last))


def abort_running(writing: Writing, match: Row[Any]) -> None:
    """Abort a match's running game, tell both players, and that the match is over."""
    running = select(games.c.id).where(games.c.match_id == match.id, games.c.status == RUNNING)
    for game_id in writing.connection.scalars(running).all():
        end_from_outside(writing, find(writing.connection, game_id), EndReason.ABORTED, None)
    notices.match_over(writing.connection, match, ABORTED)


def _header(connection: Connection, match: Row[Any], number: int, seeds: GameSeeds, start: Game) -> Header:
    return Header.of(
        EightBall(Table.from_dict(match.table)),
        start,
        seeds,
        NoiseModel(match.noise_level, match.noise_told),
        game=f"game_{secrets.token_hex(8)}",
        match=match.id,
        number=number,
        players=player_names(connection, match),
        allowance_ns=match.allowance,
        given=match.start is not None,
    )


def _finish(writing: Writing, live: LiveGame, game: Game, elapsed: int, after_last_move: Sequence[int]) -> LiveGame:
    """The game is over: its result, the end of its record, the news to both players, and what comes next."""
    outcome = game.outcome
    assert outcome is not None
    aborted = outcome.reason is EndReason.ABORTED
    entries = _count_moves(writing.connection, live.id)
    values = {
        "status": ABORTED if aborted else FINISHED,
        "winner": outcome.winner,
        "mover": None,
        "deadline": None,
        "ended_at": writing.now,
        "ending": canonical(end_entry(entries, outcome, live.seeds, after_last_move)),
    }
    live = _store(writing, live, game, elapsed, values)
    live = replace(live, score=score_of(writing.connection, live.match.id))
    notices.game_over(writing.connection, live, writing.now)
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
    notices.match_over(writing.connection, live.match, FINISHED)


def _turn(writing: Writing, match: Row[Any], game: Game, remaining: int, delivered: bool = False) -> dict[str, Any]:
    """The columns of a new turn: its clock starts when it is delivered, or by itself after a while."""
    clock_from = writing.now if delivered else writing.now + writing.context.fetch_grace
    return {
        "mover": (match.seat_0, match.seat_1)[game.turn],
        "delivered": delivered,
        "available_at": writing.now,
        "clock_from": clock_from,
        "deadline": clock_from + remaining,
        "carried": 0,
    }


def _store(writing: Writing, live: LiveGame, game: Game, elapsed: int, values: dict[str, Any]) -> LiveGame:
    """Compare-and-set on the version."""
    used = live.clocks.charged(live.game.turn, elapsed).used_ns
    values = {
        "state": game.to_dict(),
        "version": live.row.version + 1,
        "used_0": used[0],
        "used_1": used[1],
    } | values
    seen = (games.c.id == live.id) & (games.c.version == live.row.version)
    if writing.connection.execute(update(games).where(seen).values(values)).rowcount != 1:
        raise StaleVersion("the game moved on in the meantime")
    return find(writing.connection, live.id)


def _count_moves(connection: Connection, game_id: str) -> int:
    return connection.scalar(select(func.count()).where(moves.c.game_id == game_id)) or 0
