"""Compiled kernels loaded before the first player waits for them: each set when something asks for it."""

import gc
import logging
import threading
from collections.abc import Callable
from typing import Final, TypeVar

from physics import Table
from physics.engine import is_compiled
from physics.self_test import SelfTest, self_test
from server.errors import Unavailable

Answer = TypeVar("Answer")

log = logging.getLogger("pooliad.server.warmup")

LOADING_SECONDS: Final = 60.0
"""How long a request waits for kernels that lie compiled in the cache: it takes them a second or two."""


class KernelsMissing(Unavailable):
    """What the request needs is being loaded, or compiled, once for this processor."""

    seconds = 15


class KernelSet:
    """The kernels of one kind of table, and what their self-test came to.

    Attributes:
        tested: the self-test, once it has passed.
        ready: set when they are loaded and passed; failed: set, and the log has the reason, when they cannot be.
    """

    def __init__(self, jaws: bool = False) -> None:
        self.tested: SelfTest | None = None
        self.ready, self.failed = threading.Event(), threading.Event()
        self._jaws = jaws
        self._settled = threading.Event()
        self._starting = threading.Lock()
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Load them in the background, unless that has begun.

        The thread is a daemon: a server told to stop does not wait for a compiler.
        """
        with self._starting:
            if self._thread is None:
                self._thread = threading.Thread(target=self._load, name="warm-up", daemon=True)
                self._thread.start()

    def require(self) -> None:
        """Load them if need be; raises `Unavailable` until they are there, or if they do not work."""
        self.start()
        if self.failed.is_set():
            raise Unavailable("the physics of this table could not be loaded; the log says why")
        if not self.ready.is_set():
            raise KernelsMissing("the physics of this table is compiled for this processor, once; it takes minutes")

    def wait(self) -> None:
        """Until they are loaded, if they lie compiled in the cache; what takes minutes is not waited for."""
        if is_compiled(self._jaws):
            self._settled.wait(LOADING_SECONDS)

    @property
    def is_loading(self) -> bool:
        """Whether the thread is at work."""
        return self._thread is not None and self._thread.is_alive()

    @property
    def is_settled(self) -> bool:
        """Whether they are loaded, or cannot be."""
        return self._settled.is_set()

    def _load(self) -> None:
        try:
            self.tested = _tested(self._jaws)
        except Exception:
            log.exception("the physics kernels could not be loaded")
            self.failed.set()
        else:
            log.info("kernels loaded", extra={"fields": {"jaws": self._jaws, "self_test": self.tested.digest}})
            _spare_what_stays()
            self.ready.set()
        finally:
            self._settled.set()


class Kernels:
    """Both sets: a server begins with the first, and the first table with jaws asks for the second."""

    def __init__(self) -> None:
        self.straight, self.jaws = KernelSet(), KernelSet(jaws=True)

    def require(self, table: Table) -> None:
        """See `KernelSet.require`: for what is not worth beginning before its strokes can be simulated."""
        if table.has_jaws:
            self.jaws.require()

    def awaited(self, work: Callable[[], Answer]) -> Answer:
        """What `work` returns, done again when the kernels it lacked are loaded: it waits with nothing in hand."""
        try:
            return work()
        except KernelsMissing:
            self.jaws.wait()
            return work()

    @property
    def are_loading(self) -> bool:
        """Whether a thread is at work that no signal stops."""
        return self.straight.is_loading or self.jaws.is_loading


def _spare_what_stays() -> None:
    """Take what was loaded out of the garbage collector's sight.

    It is 230,000 objects that live as long as the process. A look at them all takes 0.1 s in which nothing else runs,
    and every few batches of simulations made it look.
    """
    gc.collect()
    gc.freeze()


def _tested(jaws: bool) -> SelfTest:
    result = self_test(jaws)
    if not result.ok:
        raise RuntimeError(f"the physics gives two answers to the same shot: {result}")
    return result
