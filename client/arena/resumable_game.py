"""One game of an event: played to its end, its record on disk line by line, taken up where it was broken off."""

import contextlib
import fcntl
import json
from pathlib import Path

from client.arena.game_notes import RESULT, Notes
from client.arena.game_task import GameTask, Tell
from client.arena.taken_up import Diverged, TakenUpGame
from client.session import Session
from referee.record import line_digest, read_record
from tournament import Due, GameResult
from tournament.from_record import Move, result_of, result_of_moves


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
        with contextlib.closing(Notes(folder / f"{task.due.id}.part")) as notes:
            found = _played(task, seats, notes, tell)
        Path(lock.name).unlink()
        return found


def _played(task: GameTask, seats: tuple[Session, Session], notes: Notes | None, tell: Tell) -> tuple[GameResult, str]:
    try:
        game = TakenUpGame(task, seats, notes, tell)
        played = game.play()
    except Diverged as found:
        assert notes is not None
        tell("", f"{found}; the game is played from its first stroke")
        notes.set_aside()
        game = TakenUpGame(task, seats, notes, tell)
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
