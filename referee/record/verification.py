"""Verification: play a recorded game again from its seeds and actions, and compare everything.

Nothing but the record is needed, and nothing in it is believed except who asked for what, how long they
thought, and how a game that no stroke decided was ended.
"""

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, TypeVar

from physics.errors import PhysicsError
from referee.errors import InvalidGame, RefereeError
from referee.game import Action, EndReason, Game, Outcome
from referee.play import Clocks, GameSeeds, Refused, play_stroke, seed_from_hex, start_game
from referee.record.canonical import plain
from referee.record.difference import Difference, first_difference
from referee.record.engine import Engine, this_engine
from referee.record.lines import Header, end_entry, stroke_entry
from referee.record.reading import InvalidRecord, Record, read_record

T = TypeVar("T")


class Verdict(StrEnum):
    """What verification found."""

    VERIFIED = "verified"
    """Everything follows from the seeds and the actions, to the last bit."""
    DIFFERENT = "different"
    """Something does not follow; the difference says what."""
    OTHER_ENGINE = "other_engine"
    """The record was made with another engine, which is needed to verify it."""
    MALFORMED = "malformed"
    """This is not a whole, well-formed record."""


@dataclass(frozen=True, slots=True)
class Verification:
    """The answer of ``verify_record``.

    Attributes:
        verdict: see there.
        strokes: how many strokes and decisions were verified.
        outcome: of the game, when verified.
        difference: the first one.
        needs: the engine that is needed; this_is: the one that is running.
        problem: why the record is malformed, in words.
    """

    verdict: Verdict
    strokes: int = 0
    outcome: Outcome | None = None
    difference: Difference | None = None
    needs: Engine | None = None
    problem: str | None = None

    @property
    def ok(self) -> bool:
        """Whether the record is true."""
        return self.verdict is Verdict.VERIFIED

    def __str__(self) -> str:
        match self.verdict:
            case Verdict.VERIFIED:
                return f"verified: {self.strokes} strokes and decisions follow from the seeds, bit for bit"
            case Verdict.DIFFERENT:
                return f"different after {self.strokes} good lines: {self.difference}"
            case Verdict.OTHER_ENGINE:
                return f"this record needs {self.needs}; this is {this_engine()}"
            case Verdict.MALFORMED:
                return f"malformed: {self.problem}"


def verify_record(source: str | os.PathLike[str] | Iterable[str]) -> Verification:
    """Play a recorded game again and compare: racks, noise, every event, rulings, result.

    Args:
        source: path of a record, or its lines.

    Raises:
        OSError: the file cannot be read.
    """
    try:
        record = read_record(source)
        engine = _read("engine", Engine.from_dict, record.header.get("engine"), 1)
        if engine != this_engine():
            return Verification(Verdict.OTHER_ENGINE, needs=engine)
        return _Replay(record, Header.from_dict(record.header)).run()
    except (RefereeError, PhysicsError, ValueError) as error:
        return Verification(Verdict.MALFORMED, problem=str(error))


class _Replay:
    """One game played again, line by line, until the first difference."""

    def __init__(self, record: Record, header: Header) -> None:
        self.record = record
        self.header = header
        self.seeds = _seeds(record.end)
        self.charges: list[tuple[int, int]] = []

    def run(self) -> Verification:
        """Verify the whole record."""
        game = self._start()
        if difference := self._header(game):
            return Verification(Verdict.DIFFERENT, difference=difference)
        for number, entry in enumerate(self.record.entries):
            found = self._stroke(game, entry, number)
            if isinstance(found, Difference):
                return Verification(Verdict.DIFFERENT, number, difference=found)
            game = found
        strokes = len(self.record.entries)
        found_end = self._end(game)
        if isinstance(found_end, Difference):
            return Verification(Verdict.DIFFERENT, strokes, difference=found_end)
        return Verification(Verdict.VERIFIED, strokes, outcome=found_end)

    def _start(self) -> Game:
        """The game before its first stroke: a position that was given has to be one, a rack follows from its seed."""
        rules, start = self.header.rules, self.header.start
        return rules.begin_from(start) if self.header.given else start_game(rules, self.seeds, start.breaker)

    def _header(self, game: Game) -> Difference | None:
        """The commitment and the first rack follow from the revealed seeds; nothing else is in the header."""
        derived = self.header.to_dict() | {"commitment": self.seeds.commitment, "start": game.to_dict()}
        return first_difference(self.record.header, plain(derived), line=1)

    def _stroke(self, game: Game, entry: Mapping[str, Any], number: int) -> Game | Difference:
        """The game after one line, or where the line departs from what follows."""
        line = number + 2
        action = _read("action", Action.from_dict, entry.get("action"), line)
        elapsed_ns = entry.get("elapsed_ns")
        if elapsed_ns is not None:
            self.charges.append((game.turn, _charge(elapsed_ns, line)))
        index = None if action.shot is None else game.stroke
        try:
            stroke = play_stroke(self.header.rules, game, action, self.seeds, self.header.noise)
        except Refused as refused:
            return Difference(line, index, None, None, "action", entry["action"], f"refused: {refused}")
        derived = plain(stroke_entry(stroke, number, elapsed_ns))
        return first_difference(entry, derived, line, index) or stroke.game

    def _end(self, game: Game) -> Outcome | Difference:
        """The outcome, if it is the game's own or one that may end it from outside."""
        line = len(self.record.entries) + 2
        end = self.record.end
        elapsed_ns = end.get("elapsed_ns")
        if not isinstance(elapsed_ns, list) or len(elapsed_ns) != 2:
            raise InvalidRecord(f"line {line}, elapsed_ns", elapsed_ns, "must be two integers, by seat")
        for seat in (0, 1):
            self.charges.append((seat, _charge(elapsed_ns[seat], line)))
        recorded = _read("outcome", Outcome.from_dict, end.get("outcome"), line)
        outcome = game.outcome or self._ended_outside(game, recorded)
        if outcome is None:
            return Difference(line, None, None, None, "outcome", recorded.to_dict(), "no end: the game goes on")
        derived = plain(end_entry(len(self.record.entries), outcome, self.seeds, elapsed_ns))
        return first_difference(end, derived, line) or outcome

    def _ended_outside(self, game: Game, recorded: Outcome) -> Outcome | None:
        """The outcome when ``game`` is ended for the recorded reason; None if that cannot end it."""
        loser = None if recorded.winner is None else 1 - recorded.winner
        if recorded.reason is EndReason.TIME_OUT and not self._is_out_of_time(loser):
            return None
        try:
            return self.header.rules.end(game, recorded.reason, loser).game.outcome
        except InvalidGame:
            return None

    def _is_out_of_time(self, seat: int | None) -> bool:
        allowance_ns = self.header.allowance_ns
        if seat is None or allowance_ns is None:
            return False
        return Clocks.from_charges(allowance_ns, self.charges).is_out_of_time(seat)


def _seeds(end: Mapping[str, Any]) -> GameSeeds:
    """The revealed seeds of the last line."""
    return GameSeeds(seed_from_hex(end.get("noise_seed", "")), seed_from_hex(end.get("rack_seed", "")))


def _charge(elapsed_ns: Any, line: int) -> int:
    """Thinking time as a line gives it."""
    if isinstance(elapsed_ns, bool) or not isinstance(elapsed_ns, int) or elapsed_ns < 0:
        raise InvalidRecord(f"line {line}, elapsed_ns", elapsed_ns, "must be an integer >= 0")
    return elapsed_ns


def _read(name: str, reader: Callable[[Any], T], value: Any, line: int) -> T:
    """Let ``reader`` read a part of a line; whatever it stumbles over, the record is malformed there."""
    try:
        return reader(value)
    except (ValueError, TypeError, LookupError, AttributeError, ArithmeticError) as error:
        raise InvalidRecord(f"line {line}, {name}", value, str(error)) from None
