"""Where games are played: in this process, in processes of this machine, on a Dask cluster.

All three are a ``concurrent.futures.Executor`` behind one small interface, which knows two things more: how many
pairs to have under way, and what to do when workers die under their work.
"""

import contextlib
import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any, Protocol

from client.arena.confine import end_with_parent
from client.arena.directory import EventError
from client.arena.hosted_agents import find_here
from client.arena.tasks import PairDone, PairTask, play_pair

RETRIES = 3
"""How often a pair is given to another worker after one died over it; a pair that kills four kills them all."""
DASK = "dask://"
AHEAD = 2
"""Pairs under way for each worker of a cluster, so that none waits for the next."""


Work = Callable[[Any], Any]


class WorkerLost(Exception):
    """A worker died over a pair; what it had played is kept, and the pair can be given out again."""


class Pool(Protocol):
    """Workers."""

    @property
    def capacity(self) -> int:
        """How many pairs to have under way."""

    def submit(self, task: PairTask) -> "Future[PairDone]":
        """Give a pair out. Its future raises ``WorkerLost`` through ``result_of`` when its worker died."""

    def everywhere(self, work: Work, tasks: Sequence[Any]) -> list[Any]:
        """What ``work`` makes of each task, on every machine that plays."""

    def stop(self) -> None:
        """Let go of everything at once; games that are going on are broken off."""


def result_of(future: "Future[PairDone]") -> PairDone:
    """What came of a pair.

    Raises:
        WorkerLost: its worker died.
    """
    try:
        return future.result()
    except BrokenProcessPool as error:
        raise WorkerLost(str(error)) from error
    except Exception as error:
        if type(error).__name__ in ("KilledWorker", "FutureCancelledError"):  # of distributed, which may be absent
            raise WorkerLost(str(error)) from error
        raise


class InProcess:
    """Here and now: a pair is played when it is submitted."""

    capacity = 1

    def submit(self, task: PairTask) -> "Future[PairDone]":
        """Play it."""
        return _Immediate().submit(play_pair, task)

    def everywhere(self, work: Work, tasks: Sequence[Any]) -> list[Any]:
        """One after the other."""
        return [work(task) for task in tasks]

    def stop(self) -> None:
        """Nothing goes on."""


class Processes:
    """Processes of this machine.

    They end with this one, however it ends (Linux).

    Args:
        workers: how many.
    """

    def __init__(self, workers: int) -> None:
        self.capacity = workers
        self._others = set(multiprocessing.active_children())
        self._pool = self._fresh()

    def submit(self, task: PairTask) -> "Future[PairDone]":
        """Give it out; a pool broken by a dead worker is replaced first."""
        try:
            return self._pool.submit(play_pair, task)
        except BrokenProcessPool:
            self._pool.shutdown(wait=True)
            self._pool = self._fresh()
            return self._pool.submit(play_pair, task)

    def everywhere(self, work: Work, tasks: Sequence[Any]) -> list[Any]:
        """In threads of this process, as many as there are workers: the machine is theirs."""
        with ThreadPoolExecutor(self.capacity) as threads:
            return list(threads.map(work, tasks))

    def stop(self) -> None:
        """End the workers, and with them their games."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        for worker in set(multiprocessing.active_children()) - self._others:
            worker.kill()
        self._pool.shutdown(wait=True)

    def _fresh(self) -> ProcessPoolExecutor:
        # spawn: a forked copy of a process with threads may hang on their locks
        context = multiprocessing.get_context("spawn")
        return ProcessPoolExecutor(self.capacity, context, initializer=start_worker, initargs=(os.getpid(),))


class Dask:
    """A Dask cluster: one task a pair; a task whose worker died goes to another one.

    Args:
        address: of the scheduler, ``host:port``.

    Raises:
        EventError: distributed is not installed, or nobody answers there.
    """

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client
        except ImportError:
            raise EventError("a Dask cluster needs distributed: pip install 'pooliad[cluster]'") from None
        try:
            self._client: Any = Client(address, set_as_default=False)
        except OSError as error:
            raise EventError(f"no Dask scheduler answers at {address}: {error}") from None
        # pure=False: else two pairs that look alike would be one task
        self._executor: Executor = self._client.get_executor(pure=False, retries=RETRIES)

    @property
    def capacity(self) -> int:
        """Some pairs for every thread there is now."""
        threads: dict[str, int] = self._client.nthreads()
        return max(1, AHEAD * sum(threads.values()))

    def submit(self, task: PairTask) -> "Future[PairDone]":
        """Give it out."""
        return self._executor.submit(play_pair, task)

    def everywhere(self, work: Work, tasks: Sequence[Any]) -> list[Any]:
        """On every worker there is now."""
        found: dict[str, list[Any]] = self._client.run(_each, work, list(tasks))
        return [each for answers in found.values() for each in answers]

    def stop(self) -> None:
        """Withdraw what is not done, and leave the cluster."""
        self._executor.shutdown(wait=False)
        self._client.close()


@contextlib.contextmanager
def pool_of(name: str, workers: int | None = None) -> Iterator[Pool]:
    """The pool called ``name``, stopped when the block is left.

    Args:
        name: ``inline``, ``processes`` or ``dask://host:port``.
        workers: of ``processes``; as many as this process may use cores unless given.

    Raises:
        EventError: there is no such executor.
    """
    pool = _pool(name, workers)
    try:
        yield pool
    finally:
        pool.stop()


def _pool(name: str, workers: int | None) -> Pool:
    if name == "inline":
        return InProcess()
    if name == "processes":
        return Processes(workers or cores())
    if name.startswith(DASK):
        return Dask(name.removeprefix(DASK))
    raise EventError(f"executor = {name!r}: inline, processes or dask://host:port")


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def start_worker(parent: int) -> None:
    """What a worker process does first: end with its parent, leave Ctrl-C to it, find the user's modules."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent(parent, signal.SIGKILL)
    find_here()


def _each(work: Work, tasks: Sequence[Any]) -> list[Any]:
    return [work(task) for task in tasks]


class _Immediate(Executor):
    """Runs what it is given before it returns."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """A future that is done."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future
