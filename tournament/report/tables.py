"""Results for analysis elsewhere: JSON lines and comma-separated values, one line a game."""

import csv
import io
import json
from collections.abc import Iterable, Iterator

from tournament.errors import InvalidResult
from tournament.results import GameResult

COLUMNS = (
    "pair", "leg", "attempt", "void", "player_0", "player_1", "breaker", "winner", "points_0", "points_1", "reason",
    "rule", "noise", "strokes_0", "strokes_1", "seconds_0", "seconds_1", "simulated_0", "simulated_1", "fouls_0",
    "fouls_1", "record",
)  # fmt: skip
"""Columns of the comma-separated values. Fouls are counts of all rules; the JSON lines have them by rule."""

_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""What a spreadsheet takes for the start of a formula."""


def json_lines(results: Iterable[GameResult]) -> Iterator[str]:
    """Each result as a line of JSON, without line ends."""
    for result in results:
        yield json.dumps(result.to_dict(), ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def read_json_lines(lines: Iterable[str]) -> Iterator[GameResult]:
    """Read what ``json_lines`` wrote; empty lines are passed over.

    Raises:
        InvalidResult: a line is not a result; ``field`` begins with its number.
    """
    for number, line in enumerate(lines, start=1):
        if not line.strip():
            continue
        try:
            yield GameResult.from_dict(json.loads(line))
        except InvalidResult as error:
            raise InvalidResult(f"line {number}, {error.field}", error.value, error.allowed) from None
        except (ValueError, RecursionError) as error:
            raise InvalidResult(f"line {number}", line[:60], f"must be JSON: {error}") from None


def csv_text(results: Iterable[GameResult]) -> str:
    """All results as comma-separated values (RFC 4180) with a header.

    A text that a spreadsheet would take for a formula gets an apostrophe in front.
    """
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(COLUMNS)
    for result in results:
        writer.writerow([_harmless(value) for value in _row(result)])
    return text.getvalue()


def _row(result: GameResult) -> list[object]:
    winner = "" if result.winner is None else result.players[result.winner]
    each = zip(result.strokes, result.seconds, result.simulated, result.fouls, strict=True)
    strokes, seconds, simulated, fouls = zip(*each, strict=True)
    return [
        result.pair, result.leg, result.attempt, int(result.void), *result.players, result.players[result.breaker],
        winner, *result.points, result.reason.value, result.rule, result.noise, *strokes, *seconds, *simulated,
        *(sum(rules.values()) for rules in fouls), result.record,
    ]  # fmt: skip


def _harmless(value: object) -> object:
    return f"'{value}" if isinstance(value, str) and value.startswith(_FORMULA) else value
