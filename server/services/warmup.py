"""Compiled kernels loaded before the first player waits for them."""

import logging
import threading

import physics
from server.services.context import Context

log = logging.getLogger("pooliad.server.warmup")

SHOT = physics.Shot(v=1.0, phi=270.0, theta=10.0)


def start(context: Context) -> None:
    """Play one shot in the background; `context.warm` is set when the kernels are loaded.

    `context.warm_up_failed` is set, and the log has the reason, when they cannot be.

    The thread is a daemon: a server told to stop does not wait for a compiler.
    """
    threading.Thread(target=_load, args=(context,), name="warm-up", daemon=True).start()


def _load(context: Context) -> None:
    try:
        _play()
    except Exception:
        log.exception("the physics kernels could not be loaded")
        context.warm_up_failed.set()
    else:
        log.info("kernels loaded")
        context.warm.set()


def _play() -> None:
    table = physics.Table.olympiad()
    state = physics.rack(table, "eight_ball", seed=0)
    physics.check(table, state, SHOT)
    physics.min_elevation(table, state, SHOT.phi)
    physics.simulate(table, state, SHOT)
