"""How flights end: on the cloth, in a pocket, on a rail or beyond it. Old tables have nothing of it compiled."""

from physics.kernels import layout as at
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, plain, small_kernel, store, store_integer
from physics.kernels.detect.mouths import NO_MOUTH
from physics.kernels.detect.prediction import release
from physics.kernels.detect.rail_top import hole_under, rail_at
from physics.kernels.out_of_play import drive_off, pocket
from physics.kernels.recording import note_cushion, record
from physics.kernels.resolve.boundary import touched_cushion
from physics.kernels.resolve.cloth import restate
from physics.kernels.resolve.cluster import free_from_cushions, settle
from physics.kernels.resolve.flight import fall_on_rail, meet_cloth, report_landing
from physics.kernels.resolve.touching import bring, neighbours
from physics.kernels.workspace import RealWorkspace, by_table


@apart(int, RealWorkspace, int, float)
@kernel
def land(s, i, time):
    """The flight of ball ``i`` ends, in a pocket or on the cloth; bit set of the balls to predict, or UNSETTLED."""
    bring(s, i, time)
    store(s.w, at.Z + i, 0.0)
    number = hole_under(s, load(s.w, at.X + i), load(s.w, at.Y + i))
    if number != NO_MOUTH:
        store_integer(s.k, at.PARTNER + i, number)
        pocket(s, i, time)
        return 0
    if neighbours(s, i, time) != 0 or touched_cushion(s, i) != at.NO_CUSHION:
        return settle(s, i, plain(at.NOBODY), time)
    meet_cloth(s, i, time)
    restate(s, 1 << i)
    report_landing(s, i, time)
    free_from_cushions(s, 1 << i)
    return 1 << i


@apart(int, RealWorkspace, int, float)
@kernel
def reach_rail(s, i, time):
    """Ball ``i`` falls on the top of a rail, or is beyond the outer edge; bit set of the balls still to predict.

    The top of a rail counts as a cushion. A ball that does not bounce there is off the table: it is not let roll back.
    """
    bring(s, i, time)
    if load_integer(s.k, at.KIND + i) == at.LEAVE or not fall_on_rail(s, i):
        drive_off(s, i, time)
        return 0
    restate(s, 1 << i)
    note_cushion(s, i, record(s, time, plain(at.RAIL_TOP), i, rail_at(s, load(s.w, at.X + i), load(s.w, at.Y + i))))
    return 1 << i


@apart(None, RealWorkspace, float)
@kernel
def take_off_perched(s, time):
    """Balls that others and a cushion hold up are off the table: they rest, and not on the cloth."""
    rest = load_integer(s.k, at.PERCHED_BALLS)
    store_integer(s.k, at.PERCHED_BALLS, 0)
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        release(s, i)
        drive_off(s, i, time)


@apart(None, RealWorkspace, float)
@kernel
def bring_down(s, time):
    """At the end of a shot that is cut short: what is in the air is off the table."""
    rest = load_integer(s.k, at.FLYING_BALLS)
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        drive_off(s, i, time)


@small_kernel
def no_rail(_s, _kind):
    """See ``is_at_rail``."""
    return False


@small_kernel
def rail_or_edge(_s, kind):
    """See ``is_at_rail``."""
    return (kind == at.MEET_TOP) | (kind == at.LEAVE)


@small_kernel
def is_on_cloth(_s, _i):
    """See ``is_flying``."""
    return False


@small_kernel
def is_in_flight(s, i):
    """See ``is_flying``."""
    return load_integer(s.k, at.MOTION + i) == at.FLYING


@small_kernel
def no_landing(_s, _i, _time):
    """See ``end_flight``."""
    return 0


@small_kernel
def nothing_above(_s, _time):
    """See ``cut_flights``."""


@small_kernel
def all_of(_s, alive, _time):
    """See ``still_in_play``."""
    return alive


@small_kernel
def those_in_play(s, alive, time):
    """See ``still_in_play``."""
    if load_integer(s.k, at.PERCHED_BALLS) != 0:
        take_off_perched(s, time)
    return alive & ~load_integer(s.k, at.GONE_BALLS)


is_flying = by_table(is_on_cloth, is_in_flight)
"""``is_flying(s, i)``: whether ball ``i`` is in the air."""

end_flight = by_table(no_landing, land)
"""``end_flight(s, i, time)``: see ``land``."""

is_at_rail = by_table(no_rail, rail_or_edge)
"""``is_at_rail(s, kind)``: whether an event is one of ``meet_rail``."""

meet_rail = by_table(no_landing, reach_rail)
"""``meet_rail(s, i, time)``: see ``reach_rail``."""

cut_flights = by_table(nothing_above, bring_down)
"""``cut_flights(s, time)``: see ``bring_down``."""

still_in_play = by_table(all_of, those_in_play)
"""``still_in_play(s, alive, time)``: the balls of ``alive`` that are still in play; perched ones are taken off."""
