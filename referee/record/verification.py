"""Verification: play a recorded game again from its secrets and actions, and compare everything.

Nothing but the record is needed, and nothing in it is believed except who asked for what, how long they
thought, how many shots they simulated, and how a game that no stroke decided was ended.
"""

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any, Self, TypeVar

from physics.errors import PhysicsError
from referee.errors import InvalidGame, RefereeError
from referee.game import Action, EndReason, Game, Outcome
from referee.play import Clocks, GameSeeds, Refused, play_stroke, seed_from_hex
from referee.record.canonical import plain
from referee.record.chain import PREVIOUS, chain_fault
from referee.record.difference import Difference, first_difference
from referee.record.engine import Engine, this_engine
from referee.record.lines import Header, end_entry, stroke_entry
from referee.record.reading import InvalidRecord, Record, read_record
from referee.record.signing import SealState, check_seal
from referee.record.signing_keys import PublicKey
from referee.record.verdict import RecordVerdict, Verification

T = TypeVar("T")


def verify_record(
    source: str | os.PathLike[str] | Iterable[str], keys: Iterable[PublicKey] | None = None
) -> Verification:
    """Play a recorded game again and compare: racks, noise, every event, rulings, result; check chain and signature.

    Args:
        source: path of a record, or its lines.
        keys: public keys one of which must have signed it; None: the signature is not checked.

    Raises:
        OSError: the file cannot be read.
    """
    try:
        record = read_record(source)
        chain = chain_fault(record.lines, record.objects)
    except (RefereeError, ValueError) as error:
        return Verification(RecordVerdict.MALFORMED, problem=str(error))
    try:
        found = _replayed(record)
        seal = _read("seal", lambda values: check_seal(values, keys), record.seal, len(record.lines))
    except (RefereeError, PhysicsError, ValueError) as error:
        return Verification(RecordVerdict.MALFORMED, problem=str(error), chain=chain)
    verdict = found.verdict
    if verdict is not RecordVerdict.DIFFERENT and chain is not None:
        verdict = RecordVerdict.BROKEN_CHAIN
    elif verdict is not RecordVerdict.DIFFERENT and seal.state is SealState.INVALID:
        verdict = RecordVerdict.BAD_SIGNATURE
    return replace(found, verdict=verdict, chain=chain, seal=seal)


def _replayed(record: Record) -> Verification:
    """What the game shows when it is played again, chain and seal left aside."""
    engine = _read("engine", Engine.from_dict, record.header.get("engine"), 1)
    if engine.is_same(this_engine()):
        return _Replay.of(record).run()
    try:
        found = _Replay.of(record).run()
    except (RefereeError, PhysicsError, ValueError) as error:
        return Verification(RecordVerdict.OTHER_ENGINE, needs=engine, problem=str(error))
    return replace(found, verdict=RecordVerdict.SAME_GAME if found.ok else RecordVerdict.OTHER_ENGINE, needs=engine)


class _Replay:
    """One game played again, line by line, until the first difference."""

    def __init__(self, record: Record, header: Header) -> None:
        self.record = record
        self.header = header
        self.seeds = _seeds(record.end, header, len(record.lines) - 1)
        self.charges: list[tuple[int, int]] = []

    @classmethod
    def of(cls, record: Record) -> Self:
        """The replay of a record; raises InvalidRecord if its header is none that this engine reads."""
        try:
            header = Header.from_dict(record.header)
        except (RefereeError, PhysicsError, ValueError) as error:
            raise InvalidRecord("line 1", record.header.get("game"), f"must be a header: {error}") from None
        return cls(record, header)

    def run(self) -> Verification:
        """Verify the whole record."""
        game = self.header.terms.start(self.seeds, self.header.number)
        if difference := self._header(game):
            return Verification(RecordVerdict.DIFFERENT, difference=difference)
        for number, entry in enumerate(self.record.entries):
            found = self._stroke(game, entry, number)
            if isinstance(found, Difference):
                return Verification(RecordVerdict.DIFFERENT, number, difference=found)
            game = found
        strokes = len(self.record.entries)
        found_end = self._end(game)
        if isinstance(found_end, Difference):
            return Verification(RecordVerdict.DIFFERENT, strokes, difference=found_end)
        return Verification(
            RecordVerdict.VERIFIED, strokes, outcome=found_end, budget=self.header.budget, simulated=self._simulated()
        )

    def _header(self, game: Game) -> Difference | None:
        """The commitment, breaker and first rack follow from the revealed secrets; nothing else is in the header."""
        commitment = self.header.terms.commitment(self.seeds, self.header.number)
        derived = self.header.to_dict() | {"commitment": commitment, "start": game.to_dict()}
        return _difference(self.record.header, derived, line=1)

    def _stroke(self, game: Game, entry: Mapping[str, Any], number: int) -> Game | Difference:
        """The game after one line, or where the line departs from what follows."""
        line = number + 2
        action = _read("action", Action.from_dict, entry.get("action"), line)
        elapsed_ns = entry.get("elapsed_ns")
        if elapsed_ns is not None:
            self.charges.append((game.turn, _count("elapsed_ns", elapsed_ns, line)))
        index = None if action.shot is None else game.stroke
        try:
            stroke = play_stroke(self.header.terms.rules, game, action, self.seeds, self.header.terms.noise)
        except Refused as refused:
            return Difference(line, index, None, None, "action", entry["action"], f"refused: {refused}")
        return _difference(entry, stroke_entry(stroke, number, elapsed_ns), line, index) or stroke.game

    def _end(self, game: Game) -> Outcome | Difference:
        """The outcome, if it is the game's own or one that may end it from outside."""
        line = len(self.record.entries) + 2
        end = self.record.end
        elapsed_ns = end.get("elapsed_ns")
        if not isinstance(elapsed_ns, list) or len(elapsed_ns) != 2:
            raise InvalidRecord(f"line {line}, elapsed_ns", elapsed_ns, "must be two integers, by seat")
        for seat in (0, 1):
            self.charges.append((seat, _count("elapsed_ns", elapsed_ns[seat], line)))
        recorded = _read("outcome", Outcome.from_dict, end.get("outcome"), line)
        outcome = game.outcome or self._ended_outside(game, recorded)
        if outcome is None:
            return Difference(line, None, None, None, "outcome", recorded.to_dict(), "no end: the game goes on")
        simulated, budget = self._simulated(), self.header.budget
        if simulated and budget and max(simulated) > budget.simulations:
            allowed = f"at most {budget.simulations} for each: no more is granted"
            return Difference(line, None, None, None, "simulated", list(simulated), allowed)
        derived = end_entry(len(self.record.entries), outcome, self.seeds, elapsed_ns, simulated)
        return _difference(end, derived, line) or outcome

    def _simulated(self) -> tuple[int, int] | None:
        """What was counted against the budget, by seat; None without one."""
        if self.header.budget is None:
            return None
        line, counts = len(self.record.entries) + 2, self.record.end.get("simulated")
        if not isinstance(counts, list) or len(counts) != 2:
            raise InvalidRecord(f"line {line}, simulated", counts, "must be two integers, by seat")
        return _count("simulated", counts[0], line), _count("simulated", counts[1], line)

    def _ended_outside(self, game: Game, recorded: Outcome) -> Outcome | None:
        """The outcome when ``game`` is ended for the recorded reason; None if that cannot end it."""
        loser = None if recorded.winner is None else 1 - recorded.winner
        if recorded.reason is EndReason.TIME_OUT and not self._is_out_of_time(loser):
            return None
        try:
            return self.header.terms.rules.end(game, recorded.reason, loser).game.outcome
        except InvalidGame:
            return None

    def _is_out_of_time(self, seat: int | None) -> bool:
        allowance_ns = self.header.allowance_ns
        if seat is None or allowance_ns is None:
            return False
        return Clocks.from_charges(allowance_ns, self.charges).is_out_of_time(seat)


def _difference(
    recorded: Mapping[str, Any], derived: Mapping[str, Any], line: int, stroke: int | None = None
) -> Difference | None:
    """The first difference of a line; the chain is looked at by itself."""
    chained = plain(derived) | {PREVIOUS: recorded.get(PREVIOUS)}
    return first_difference(recorded, chained, line, stroke)


def _seeds(end: Mapping[str, Any], header: Header, line: int) -> GameSeeds:
    """The game's seeds: the revealed secrets, and what the players added."""
    noise, racks = (_read(name, seed_from_hex, end.get(name), line) for name in ("noise_secret", "rack_secret"))
    return GameSeeds(noise, racks, header.client_seeds, header.terms.shared_racks)


def _count(name: str, value: Any, line: int) -> int:
    """A number of nanoseconds or of shots as a line gives it."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise InvalidRecord(f"line {line}, {name}", value, "must be an integer >= 0")
    return value


def _read(name: str, reader: Callable[[Any], T], value: Any, line: int) -> T:
    """Let ``reader`` read a part of a line; whatever it stumbles over, the record is malformed there."""
    try:
        return reader(value)
    except (ValueError, TypeError, LookupError, AttributeError, ArithmeticError) as error:
        raise InvalidRecord(f"line {line}, {name}", value, str(error)) from None
