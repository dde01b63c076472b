"""From a game's record to what standings and statistics need of it."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from referee.game import EndReason, Outcome
from referee.game.rule_id import plain_id
from referee.play.clock import SECOND_NS
from referee.record import Record
from tournament.pairings import Due
from tournament.results import GameResult


def called_off(due: Due) -> GameResult:
    """The result of a game that was called off before it began: it counts for nothing, and is played again."""
    return GameResult(
        due.pair.id,
        due.leg,
        due.pair.players,
        due.breaker,
        None,
        EndReason.ABORTED,
        noise=due.pair.noise,
        attempt=due.attempt,
    )


def result_of(record: Record, due: Due, simulated: Sequence[int] = (0, 0), place: str = "") -> GameResult:
    """The result of a finished game.

    Args:
        record: of the game. due: which game of the event it is.
        simulated: shots simulated, by seat; no record holds them.
        place: where the record is; in an event's own directory unless given.
    """
    moves = (
        Move(entry["seat"], entry["stroke"] is not None, entry["ruling"]["fouls"], entry["elapsed_ns"])
        for entry in record.entries
    )
    return result_of_moves(
        Outcome.from_dict(record.end["outcome"]), moves, record.end["elapsed_ns"], due, simulated, place
    )


class Move(NamedTuple):
    """What a result counts of a stroke or a decision.

    Attributes:
        seat: who. is_stroke: whether it was one. fouls: ids of rules. elapsed_ns: charged for it; None without clocks.
    """

    seat: int
    is_stroke: bool
    fouls: Iterable[str]
    elapsed_ns: int | None


def result_of_moves(
    outcome: Outcome,
    moves: Iterable[Move],
    after_ns: Sequence[int],
    due: Due,
    simulated: Sequence[int] = (0, 0),
    place: str = "",
) -> GameResult:
    """The result of a game that was watched; `after_ns`: charged after its last move, by seat. Else as `result_of`."""
    strokes, fouls, charged = [0, 0], (Counter[str](), Counter[str]()), list(after_ns)
    for move in moves:
        strokes[move.seat] += move.is_stroke
        fouls[move.seat].update(map(plain_id, move.fouls))
        charged[move.seat] += move.elapsed_ns or 0
    return GameResult(
        pair=due.pair.id,
        leg=due.leg,
        players=due.pair.players,
        breaker=due.breaker,
        winner=outcome.winner,
        reason=outcome.reason,
        rule=outcome.rule,
        noise=due.pair.noise,
        strokes=(strokes[0], strokes[1]),
        seconds=(charged[0] / SECOND_NS, charged[1] / SECOND_NS),
        simulated=(simulated[0], simulated[1]),
        fouls=(dict(sorted(fouls[0].items())), dict(sorted(fouls[1].items()))),
        record=place or f"games/{due.id}.jsonl",
        attempt=due.attempt,
    )
