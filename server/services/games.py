"""The course of a match.

A game begins, goes on with every move, ends; the next begins, or the match is over.
"""

import secrets
from dataclasses import replace
from typing import Any, Literal

from sqlalchemy import Connection, Row, insert, select, update

from physics import Table
from referee.game import EndReason, Game
from referee.play import MatchSeed, start_game
from referee.rules import EightBall
from referee.wire import GameOver, MatchOver, OutcomeView
from server.errors import StaleVersion
from server.services.context import Context
from server.services.live import ABORTED, FINISHED, RUNNING, LiveGame, find, score_of
from server.store.tables import games, matches, notices

FIRST_VERSION = 1


def start(connection: Connection, context: Context, match: Row[Any], number: int, now: int) -> None:
    """Rack the match's next game; its commitment is public from here on."""
    seed = MatchSeed.from_hex(match.seed)
    seeds, breaker = seed.game(number), seed.breaker(number)
    game = start_game(EightBall(Table.from_dict(match.table)), seeds, breaker)
    row = {
        "id": f"game_{secrets.token_hex(8)}",
        "match_id": match.id,
        "number": number,
        "noise_seed": seeds.noise.hex(),
        "commitment": seeds.commitment,
        "breaker": breaker,
        "state": game.to_dict(),
        "version": FIRST_VERSION,
        "status": RUNNING,
        "used_0": 0,
        "used_1": 0,
        "started_at": now,
    }
    connection.execute(insert(games).values(row | _turn(context, match, game, match.allowance, now)))


def advance(
    connection: Connection, context: Context, live: LiveGame, game: Game, charge: int, now: int
) -> LiveGame:
    """Store what a move made of a game, `charge` nanoseconds off the mover's clock, and what follows from it.

    The mover who stays at the table has the next view in the answer, so the clock goes on at once.
    Raises `StaleVersion` when somebody else was first.
    """
    mover = live.game.turn
    clocks = live.clocks.charged(mover, charge)
    values: dict[str, Any] = {"used_0": clocks.used_ns[0], "used_1": clocks.used_ns[1]}
    if game.is_over:
        return _finish(connection, context, live, game, values, now)
    values |= _turn(
        context, live.match, game, clocks.remaining_ns(game.turn), now, delivered=game.turn == mover
    )
    return _store(connection, live, game, values)


def end_from_outside(
    connection: Connection, context: Context, live: LiveGame, reason: EndReason, loser: int | None, now: int
) -> LiveGame:
    """R48.

    End a running game for a reason that is not on the table; the time of the running turn is charged.
    """
    ruling = live.rules.end(live.game, reason, loser)
    clocks = live.clocks.charged(live.game.turn, live.elapsed(now))
    used = {"used_0": clocks.used_ns[0], "used_1": clocks.used_ns[1]}
    return _finish(connection, context, live, ruling.game, used, now)


def abort_running(connection: Connection, context: Context, match: Row[Any], now: int) -> None:
    """Abort a match's running game, tell both players, and that the match is over."""
    running = select(games.c.id).where(games.c.match_id == match.id, games.c.status == RUNNING)
    for game_id in connection.scalars(running).all():
        end_from_outside(connection, context, find(connection, game_id), EndReason.ABORTED, None, now)
    _match_over(connection, match, ABORTED)


def _finish(
    connection: Connection, context: Context, live: LiveGame, game: Game, values: dict[str, Any], now: int
) -> LiveGame:
    assert game.outcome is not None
    aborted = game.outcome.reason is EndReason.ABORTED
    values |= {
        "status": ABORTED if aborted else FINISHED,
        "winner": game.outcome.winner,
        "mover": None,
        "deadline": None,
        "ended_at": now,
    }
    live = _store(connection, live, game, values)
    live = replace(live, score=score_of(connection, live.match.id))
    for seat in (0, 1):
        _notify(connection, live.agents[seat], _game_over(connection, live, seat, now))
    if not aborted:
        _go_on(connection, context, live, now)
    return live


def _go_on(connection: Connection, context: Context, live: LiveGame, now: int) -> None:
    """The next game of the match, or its end."""
    if live.row.number + 1 < live.match.games:
        start(connection, context, live.match, live.row.number + 1, now)
        return
    finished = matches.c.id == live.match.id
    connection.execute(update(matches).where(finished).values(status=FINISHED, ended_at=now))
    _match_over(connection, live.match, FINISHED)


def _turn(
    context: Context, match: Row[Any], game: Game, remaining: int, now: int, delivered: bool = False
) -> dict[str, Any]:
    """The columns of a new turn: its clock starts when it is delivered, or by itself after a while."""
    clock_from = now if delivered else now + context.fetch_grace
    return {
        "mover": (match.seat_0, match.seat_1)[game.turn],
        "delivered": delivered,
        "available_at": now,
        "clock_from": clock_from,
        "deadline": clock_from + remaining,
    }


def _store(connection: Connection, live: LiveGame, game: Game, values: dict[str, Any]) -> LiveGame:
    """Compare-and-set on the version."""
    seen = (games.c.id == live.id) & (games.c.version == live.row.version)
    version = live.row.version + 1
    changed = connection.execute(
        update(games).where(seen).values(state=game.to_dict(), version=version, **values)
    )
    if changed.rowcount != 1:
        raise StaleVersion("the game moved on in the meantime")
    return find(connection, live.id)


def _game_over(connection: Connection, live: LiveGame, seat: int, now: int) -> GameOver:
    outcome = live.game.outcome
    assert outcome is not None
    return GameOver(
        game=live.id,
        match=live.match.id,
        number=live.row.number,
        seat=seat,
        outcome=OutcomeView.of(outcome),
        won=None if outcome.winner is None else outcome.winner == seat,
        score=live.score,
        noise_seed=live.row.noise_seed,
        record=f"/v1/games/{live.id}/record",
        view=live.view(connection, seat, now),
    )


def _match_over(connection: Connection, match: Row[Any], status: Literal["finished", "aborted"]) -> None:
    score = score_of(connection, match.id)
    for seat, agent in enumerate((match.seat_0, match.seat_1)):
        message = MatchOver(
            match=match.id, seat=seat, status=status, winner=winner_of(status, score), score=score
        )
        _notify(connection, agent, message)


def winner_of(status: str, score: tuple[float, float]) -> int | None:
    """The seat that won a match; None while it is on, when it is drawn or aborted."""
    return int(score[1] > score[0]) if status == FINISHED and score[0] != score[1] else None


def _notify(connection: Connection, agent: str, message: GameOver | MatchOver) -> None:
    connection.execute(insert(notices).values(agent_id=agent, message=message.model_dump_json()))
