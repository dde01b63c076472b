"""How a ball goes out of play: it drops into a pocket, or is driven off the table."""

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load_integer, plain, store_fact, store_integer
from physics.kernels.recording import record
from physics.kernels.resolve.touching import bring
from physics.kernels.start import put_away


@kernel
def pocket(s, i, time):
    """Ball ``i`` reaches a mouth: it is recorded where it crosses, and out of play."""
    bring(s, i, time)
    number = load_integer(s.k, at.PARTNER + i)
    store_integer(s.k, at.MOTION + i, at.POCKETED)
    event = record(s, time, plain(at.POCKET_COLLISION), i, number)
    store_fact(s.facts, at.F_POCKETED + i, event)
    store_fact(s.facts, at.F_POCKET + i, number)
    put_away(s, i, at.POCKETED)


@kernel
def drive_off(s, i, time):
    """Ball ``i``, brought to ``time``, is off the table: it is recorded where it is, and out of play."""
    store_integer(s.k, at.MOTION + i, at.DRIVEN_OFF)
    event = record(s, time, plain(at.OFF_TABLE), i, plain(at.NOBODY))
    store_fact(s.facts, at.F_OFF_TABLE + i, event)
    put_away(s, i, at.DRIVEN_OFF)
