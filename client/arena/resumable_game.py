"""One game of an event: played to its end, its record on disk line by line, taken up where it was broken off."""

import contextlib
import fcntl
import json
import os
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from client.arena.directory import flush_folder
from client.local import over_message
from client.local_game import TRIES, BadAction, Lost, PlayedGame, Watch, play_game, points_of
from client.session import Session
from physics import Table
from protocol import View
from referee import Action, EightBall, EndReason, GameSeeds, NoiseModel
from referee.play import Refused, nanoseconds
from referee.play.budget import Budgets, budgets
from referee.play.clock import Timing
from referee.record import line_digest, read_record
from referee.record.canonical import canonical, parse
from tournament import Due, GameResult
from tournament.from_record import Move, result_of, result_of_moves

RESULT = ".result.json"
"""Beside a record: its game's result, with the simulated shots, which no record holds."""
LONGEST_REPORT = 500
"""Letters of a report: enough for a message, too few for what a broken agent may print."""

Tell = Callable[[str, str], None]
"""Told of an entrant (its name) what went wrong with it (a sentence)."""


@dataclass(frozen=True, slots=True)
class GameTask:
    """A game to be played.

    Attributes:
        due: which. seeds: its secrets.
        table: parameters. noise: of this game.
        seconds: clock, None without. simulated_shots: budget, None without.
    """

    due: Due
    seeds: GameSeeds
    table: str | dict[str, Any]
    noise: NoiseModel
    seconds: float | None
    simulated_shots: int | None


class Diverged(Exception):
    """The record of a game that was broken off does not follow from its seeds: another engine began it."""


def play(task: GameTask, seats: tuple[Session, Session], folder: Path | None, tell: Tell) -> tuple[GameResult, str]:
    """Play a game to its end, unless that was done before.

    In ``folder`` the game leaves ``ID.part`` while it goes on, and ``ID.jsonl``, its record, when it is over.
    Moves that stand in ``ID.part`` are not made again. A second caller waits for the first one, and gets its result.

    Args:
        task: the game.
        seats: the players, by seat.
        folder: where records are kept; None: nowhere, and the game is played from its first stroke.
        tell: told what goes wrong with a player.

    Returns:
        The result, and the record.
    """
    if folder is None:
        return _played(task, seats, None, tell)
    with (folder / f"{task.due.id}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        final = folder / f"{task.due.id}.jsonl"
        if final.exists():
            return _recovered(final, task.due), final.read_text(encoding="utf-8")
        with contextlib.closing(_Notes(folder / f"{task.due.id}.part")) as notes:
            found = _played(task, seats, notes, tell)
        Path(lock.name).unlink()
        return found


def _played(
    task: GameTask, seats: tuple[Session, Session], notes: "_Notes | None", tell: Tell
) -> tuple[GameResult, str]:
    try:
        game = _Game(task, seats, notes, tell)
        played = game.play()
    except Diverged as found:
        assert notes is not None
        tell("", f"{found}; the game is played from its first stroke")
        notes.set_aside()
        game = _Game(task, seats, notes, tell)
        played = game.play()
    text = "".join(f"{line}\n" for line in (*game.lines, *played.last_lines(line_digest(game.lines[-1]))))
    timed = zip(played.strokes, played.elapsed_ns, strict=True)
    moves = (Move(stroke.seat, stroke.index is not None, stroke.ruling.fouls, elapsed) for stroke, elapsed in timed)
    result = result_of_moves(played.outcome, moves, played.after_ns, task.due, played.simulated)
    if notes is not None:
        notes.finish(text, result)
    return result, text


def _recovered(record: Path, due: Due) -> GameResult:
    """The result of a game that is over: as it was kept, or from the record if a power cut took that."""
    try:
        return GameResult.from_dict(json.loads(record.with_suffix(RESULT).read_text(encoding="utf-8")))
    except (OSError, ValueError):
        return result_of(read_record(record), due)


class _Notes:
    """The file of a game that goes on: lines of its record, and how much of the budgets is spent.

    Lines are handed to the system as they come, so that they survive this process; the disk gets them when the
    game is over. A machine that loses power takes the game up some strokes earlier, with the same noise.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file: IO[bytes] | None = None
        self.lines: list[str] = []
        self.spent = (0, 0)
        for line in _complete_lines(path):
            if line.startswith('{"spent":'):
                first, second = parse(line)["spent"]
                self.spent = first, second
            else:
                self.lines.append(line)

    def add(self, line: str, spent: tuple[int, int]) -> None:
        """Keep a line of the record."""
        text = f"{line}\n" if spent == self.spent else f"{canonical({'spent': list(spent)})}\n{line}\n"
        self.spent = spent
        file = self._opened()
        file.write(text.encode())
        file.flush()

    def finish(self, record: str, result: GameResult) -> None:
        """The game is over: put result and record in their places, the record on the disk."""
        self.close()
        self._path.with_suffix(RESULT).write_text(json.dumps(result.to_dict()), encoding="utf-8")
        with self._path.open("wb") as file:
            file.write(record.encode())
            file.flush()
            os.fsync(file.fileno())
        self._path.rename(self._path.with_suffix(".jsonl"))
        flush_folder(self._path.parent)

    def set_aside(self) -> None:
        """Begin with nothing; what there was is kept beside it."""
        self.close()
        self._path.rename(self._path.with_suffix(f".{time.time_ns()}.diverged"))
        self.lines, self.spent = [], (0, 0)

    def _opened(self) -> IO[bytes]:
        """The file, what was torn off cut away."""
        if self._file is None:
            whole = "".join(f"{line}\n" for line in _complete_lines(self._path)).encode()
            self._file = self._path.open("r+b" if self._path.exists() else "w+b")
            self._file.truncate(len(whole))
            self._file.seek(len(whole))
        return self._file

    def close(self) -> None:
        """Let go of the file; what was handed to the system stays."""
        if self._file is not None:
            self._file.close()
            self._file = None


def _complete_lines(path: Path) -> list[str]:
    """The lines that are whole; what a power cut left of a line is none."""
    try:
        whole = path.read_bytes().rpartition(b"\n")[0]
    except FileNotFoundError:
        return []
    lines = []
    for line in whole.split(b"\n") if whole else []:
        try:
            parse(line.decode())
        except ValueError:
            break
        lines.append(line.decode())
    return lines


class _Game:
    """A game being played, perhaps for the second time up to where it was broken off."""

    def __init__(self, task: GameTask, seats: tuple[Session, Session], notes: _Notes | None, tell: Tell) -> None:
        self.lines: list[str] = []
        self._task = task
        self._seats = seats
        self._notes = notes
        self._tell = tell
        self._past = deque(notes.lines if notes else ())
        self._made = deque(parse(line) for line in list(self._past)[1:])
        self._rules = EightBall(Table.of(task.table))
        self._budgets: Budgets = budgets(task.simulated_shots)
        self._spent = notes.spent if notes else (0, 0)
        self._now = 0
        self._last: list[View | None] = [None, None]

    def play(self) -> PlayedGame:
        """Play it to its end, and tell the players."""
        task, due = self._task, self._task.due
        for seat, budget in zip(self._seats, self._budgets, strict=True):
            seat.begin(budget)
        played = play_game(
            self._rules,
            (self._chair(0), self._chair(1)),
            task.seeds,
            task.noise,
            breaker=due.breaker,
            players=due.pair.players,
            match=due.pair.id,
            game=due.id,
            budget=self._budgets,
            timing=None if task.seconds is None else Timing(nanoseconds(task.seconds), lambda: self._now),
            watch=Watch(on_refusal=self._refused, on_line=self._line),
        )
        self._say_over(played)
        return played

    def _chair(self, seat: int) -> Callable[[View], Action]:
        return lambda view: self._choose(seat, view)

    def _choose(self, seat: int, view: View) -> Action:
        """The move that stands already, or the player's answer."""
        self._last[seat] = view
        if self._made:
            return self._again(seat, view)
        left = view.clocks[seat].seconds_left
        started = time.monotonic_ns()
        try:
            return self._seats[seat].ask(view)
        except Lost as lost:
            if lost.reason is EndReason.TIME_OUT:  # measured by another clock than ours: it was all of it
                started = min(started, time.monotonic_ns() - nanoseconds(left or 0.0))
            raise
        finally:
            self._now += time.monotonic_ns() - started

    def _again(self, seat: int, view: View) -> Action:
        """A move made before the game was broken off: it stands.

        Without clocks the player is walked through its own moves, so that it remembers what it knew; if it has
        changed its mind, that comes too late. With clocks nobody thinks twice about the same turn.
        """
        entry = self._made.popleft()
        action = Action.from_dict(entry["action"])
        self._now += entry["elapsed_ns"] or 0
        if self._task.seconds is None:
            self._walk(seat, view, action)
        if not self._made:
            self._restore_budgets()
        return action

    def _walk(self, seat: int, view: View, made: Action) -> None:
        """Ask for a move that is known, as often as it was asked for then."""
        for _ in range(TRIES):
            try:
                answer = self._seats[seat].ask(view)
            except Lost as lost:
                self._report(seat, f"{lost} while it was walked through moves it had made")
                return
            except Exception:
                continue
            if not (refusals := self._rules.check(view.to_game(), answer)):
                break
            self._seats[seat].refused(str(Refused(refusals)))
        else:
            return
        if _plain(answer) != _plain(made):
            self._report(seat, f"would play stroke {view.stroke} otherwise the second time; what it played stands")

    def _restore_budgets(self) -> None:
        for budget, spent in zip(self._budgets, self._spent, strict=True):
            budget.used = max(budget.used, spent)

    def _line(self, line: str) -> None:
        """A line of the record is final: one that stood already must be the same, a new one is kept."""
        self.lines.append(line)
        if self._past:
            if self._past.popleft() != line:
                raise Diverged(f"line {len(self.lines)} of {self._task.due.id} does not follow from its seeds")
        elif self._notes is not None:
            self._notes.add(line, (self._budgets[0].used, self._budgets[1].used))

    def _refused(self, bad: BadAction) -> None:
        if bad.attempt == 1:
            self._report(bad.seat, f"bad answer: {bad.reason}")
        if isinstance(bad.reason, Refused):
            self._seats[bad.seat].refused(str(bad.reason))

    def _report(self, seat: int, what: str) -> None:
        self._tell(self._task.due.pair.players[seat], f"{self._task.due.id}: {what}"[:LONGEST_REPORT])

    def _say_over(self, played: PlayedGame) -> None:
        """Tell the players who were asked."""
        score = points_of(played.outcome)
        for number, (seat, last) in enumerate(zip(self._seats, self._last, strict=True)):
            if last is not None:
                seat.over(over_message(played, number, last, score))


def _plain(action: Action) -> str:
    """An action as its record has it: negative zeros are zeros there."""
    values = action.to_dict()
    if action.shot is not None:
        values["shot"] = {name: value + 0.0 for name, value in values["shot"].items()}
    if action.cue_ball is not None:
        values["cue_ball"] = [value + 0.0 for value in action.cue_ball]
    return canonical(values)
