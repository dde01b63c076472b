"""Running an event: pairs are given out in order, results come back in any, and the journal holds what counts."""

import itertools
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, wait

from client.arena.directory import EventDirectory, EventError, write_whole
from client.arena.executors import RETRIES, Pool, WorkerLost, result_of
from client.arena.preflight import require_startable
from client.arena.tasks import PairDone, PairTask
from client.arena.terms import Terms
from tournament import Due, Tournament, TournamentError
from tournament.ledger import Ledger

LOOK_EVERY = 0.5
"""Seconds between looks into the journal for what an organiser has decided meanwhile."""

Observer = Callable[[Ledger, int], None]
"""Told how the event stands and how many pairs are under way, after every change and at every look."""


class Runner:
    """One event, one pool, from wherever the journal stands to the end.

    Args:
        directory: of the event.
        pool: plays the games.
        observer: is told how it goes.
    """

    def __init__(
        self, directory: EventDirectory, pool: Pool, observer: Observer = lambda ledger, running: None
    ) -> None:
        self._directory = directory
        self._journal = directory.journal
        self._terms = Terms.from_dict(directory.terms())
        self._pool = pool
        self._observer = observer
        self._ledger = Ledger(Tournament(self._terms.spec))
        self._running: dict[Future[PairDone], PairTask] = {}
        self._lost: dict[str, int] = {}

    def run(self) -> Ledger:
        """Play until nothing is due, or the event is paused with no game under way, or aborted.

        Raises:
            EventError: an entrant cannot be made or started, a pair kills every worker that plays it, or another
                process runs this event.
        """
        with self._directory.alone():
            self._journal.append("begun")
            self._look()
            if self._ledger.event.due and not self._ledger.paused:
                require_startable(self._terms, self._pool, self._directory.logs, self._ledger.event.withdrawn)
            while not self._ledger.over:
                self._give_out()
                if not self._running:
                    break
                self._collect()
            self._journal.append("left", over=self._ledger.over, paused=self._ledger.paused)
        return self._ledger

    def _look(self) -> None:
        """Take in what the journal says that is new."""
        try:
            self._ledger = self._ledger.after(self._journal.new())
        except TournamentError as error:
            raise EventError(f"{self._journal.path} does not fit the event: {error}") from None
        self._observer(self._ledger, len(self._running))

    def _give_out(self) -> None:
        """Submit pairs in their order, while there is room."""
        if self._ledger.paused:
            return
        under_way = {task.pair for task in self._running.values()}
        for pair, due in itertools.groupby(self._ledger.event.due, key=lambda one: one.pair):
            if len(self._running) >= self._pool.capacity or any(map(self._is_suspect, under_way)):
                return
            if pair.id not in under_way and not (self._is_suspect(pair.id) and under_way):
                self._submit(tuple(due))
                under_way.add(pair.id)

    def _is_suspect(self, pair: str) -> bool:
        """Whether workers died over this pair again and again: then it plays alone, so that no other is blamed."""
        return self._lost.get(pair, 0) > 1

    def _submit(self, due: tuple[Due, ...]) -> None:
        task = self._terms.task(due, self._directory.path.resolve())
        self._running[self._pool.submit(task)] = task

    def _collect(self) -> None:
        """Wait a little for pairs to be done, and keep what came of them."""
        done, _ = wait(self._running, timeout=LOOK_EVERY, return_when=FIRST_COMPLETED)
        for future in done:
            task = self._running.pop(future)
            try:
                self._keep(task, result_of(future))
            except WorkerLost as error:
                self._again(task, error)
        self._look()

    def _keep(self, task: PairTask, done: PairDone) -> None:
        """Put the records in their place first, then the results into the journal."""
        for game, record in zip(task.games, done.records, strict=False):
            write_whole(self._directory.games / f"{game.due.id}.jsonl", record.encode())
        for name, what in done.reports:
            self._journal.append("incident", entrant=name, pair=task.pair, what=what)
        for result in done.results:
            self._journal.append("game", result=result.to_dict())

    def _again(self, task: PairTask, error: WorkerLost) -> None:
        """A worker died: the pair will be given out again, unless it has killed too many."""
        self._lost[task.pair] = self._lost.get(task.pair, 0) + 1
        self._journal.append("incident", entrant="", pair=task.pair, what=f"its worker died: {error}")
        if self._lost[task.pair] > RETRIES:
            raise EventError(f"pair {task.pair} has lost {self._lost[task.pair]} workers; the journal has their ends")
