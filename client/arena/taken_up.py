"""A game from where it was broken off: the moves that stand are made again, then the players are asked."""

import time
from collections import deque
from collections.abc import Callable

from client.arena.game_notes import Notes
from client.arena.game_task import GameTask, Tell
from client.local import over_message
from client.local_game import TRIES, BadAction, Lost, PlayedGame, Watch, play_game, points_of
from client.session import Session
from physics import Table
from protocol import View
from referee import Action, EightBall, EndReason
from referee.play import Refused, nanoseconds
from referee.play.budget import Budgets, budgets
from referee.play.clock import Timing
from referee.record.canonical import canonical, parse

LONGEST_REPORT = 500
"""Letters of a report: enough for a message, too few for what a broken agent may print."""


class Diverged(Exception):
    """The record of a game that was broken off does not follow from its seeds: another engine began it."""


class TakenUpGame:
    """A game being played, perhaps for the second time up to where it was broken off."""

    def __init__(self, task: GameTask, seats: tuple[Session, Session], notes: Notes | None, tell: Tell) -> None:
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
