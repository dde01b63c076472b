"""Compiled kernels loaded before the first player waits for them."""

import gc
import logging
import threading

from physics.self_test import SelfTest, self_test
from server.services.runtime.context import Context

log = logging.getLogger("pooliad.server.warmup")


def start(context: Context) -> None:
    """Run the physics' self-test in the background; `context.warm` is set when it passed and the kernels are loaded.

    `context.warm_up_failed` is set, and the log has the reason, when they cannot be.

    The thread is a daemon: a server told to stop does not wait for a compiler.
    """
    threading.Thread(target=_load, args=(context,), name="warm-up", daemon=True).start()


def _load(context: Context) -> None:
    try:
        result = _tested()
    except Exception:
        log.exception("the physics kernels could not be loaded")
        context.warm_up_failed.set()
    else:
        log.info("kernels loaded", extra={"fields": {"self_test": result.digest}})
        context.self_test.append(result)
        _spare_what_stays()
        context.warm.set()


def _spare_what_stays() -> None:
    """Take what was loaded out of the garbage collector's sight.

    It is 230,000 objects that live as long as the process. A look at them all takes 0.1 s in which nothing else runs,
    and every few batches of simulations made it look.
    """
    gc.collect()
    gc.freeze()


def _tested() -> SelfTest:
    result = self_test()
    if not result.ok:
        raise RuntimeError(f"the physics gives two answers to the same shot: {result}")
    return result
