"""News for the players: a seed is wanted, a game is over, the match is over.

Each is delivered once, before any turn.
"""

from typing import Any, Literal

from sqlalchemy import Connection, Row, insert

from protocol import GameOver, MatchOver, OutcomeView, SeedWanted
from server.services.play.live_game import FINISHED, LiveGame, score_of
from server.store.tables import notices


def game_over(connection: Connection, live: LiveGame, now: int) -> None:
    """Tell both players, each with the own view and, unless noise is withheld, the revealed seed."""
    outcome = live.game.outcome
    assert outcome is not None
    for seat in (0, 1):
        message = GameOver(
            game=live.id,
            match=live.match.id,
            number=live.row.number,
            seat=seat,
            outcome=OutcomeView.of(outcome),
            won=None if outcome.winner is None else outcome.winner == seat,
            score=live.fixture.score,
            noise_seed=None if live.fixture.withheld else live.row.noise_seed,
            record=f"/v1/games/{live.id}/record",
            view=live.view(connection, seat, now),
        )
        _notify(connection, live.agents[seat], message)


def match_over(connection: Connection, match: Row[Any], status: Literal["finished", "aborted"]) -> None:
    """Tell both players."""
    score = score_of(connection, match.id)
    winner = winner_of(status, score)
    for seat, agent in enumerate((match.seat_0, match.seat_1)):
        message = MatchOver(match=match.id, seat=seat, status=status, winner=winner, score=score)
        _notify(connection, agent, message)


def seeds_wanted(connection: Connection, match: Row[Any], seconds: float) -> None:
    """Tell those players who have not added a seed that they may, and how long."""
    added = (match.client_seed_0, match.client_seed_1)
    for seat, agent in enumerate((match.seat_0, match.seat_1)):
        if added[seat] is None:
            message = SeedWanted(match=match.id, seat=seat, commitment=match.commitment, seconds=seconds)
            _notify(connection, agent, message)


def winner_of(status: str, score: tuple[float, float]) -> int | None:
    """The seat that won a match; None while it is on, when it is drawn or aborted."""
    return int(score[1] > score[0]) if status == FINISHED and score[0] != score[1] else None


def _notify(connection: Connection, agent: str, message: SeedWanted | GameOver | MatchOver) -> None:
    connection.execute(insert(notices).values(agent_id=agent, message=message.model_dump_json()))
