"""The cloth in the contact rule: a third body for balls that go down onto it. On old tables there is nothing of it."""

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store, store_integer
from physics.kernels.resolve.cloth import restate
from physics.kernels.resolve.flight import any_flies, meet_cloth, report_landing
from physics.kernels.tolerances import PERCHED_AFTER
from physics.kernels.workspace import by_table


@kernel
def goes_down(s, members):
    """See ``landing_balls``."""
    found = 0
    rest = members if load(s.p, at.P_FLIGHT) != 0.0 else 0
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        if load(s.w, at.Z + i) == 0.0 and load(s.w, at.VZ + i) < 0.0:
            found |= 1 << i
    return found


@small_kernel
def none_goes_down(_s, _members):
    """See ``landing_balls``."""
    return 0


landing_balls = by_table(none_goes_down, goes_down)
"""``landing_balls(s, members)``: bit set of the members that are at the cloth and going down."""


@kernel
def meet_cloth_and_report(s, members, landing, time):
    """See ``meet_cloths``."""
    rest = goes_down(s, members)
    found = rest
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        meet_cloth(s, i, time)
        restate(s, 1 << i)
        if landing >> i & 1:
            report_landing(s, i, time)
    return found


@small_kernel
def meet_no_cloth(_s, _members, _landing, _time):
    """See ``meet_cloths``."""
    return 0


meet_cloths = by_table(meet_no_cloth, meet_cloth_and_report)
"""``meet_cloths(s, members, landing, time)``: the cloth's round: impacts of the members that go down onto it, recorded
for those in ``landing``; bit set of them all."""


@kernel
def stop_going_down(s, members):
    """See ``press_down``."""
    found = goes_down(s, members)
    rest = found
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        store(s.w, at.VZ + i, 0.0)
    return found


press_down = by_table(none_goes_down, stop_going_down)
"""``press_down(s, members)``: the cloth takes what step 3 leaves of a motion into it; bit set of the balls changed."""


@small_kernel
def count_none(_s, _changed):
    """See ``count_partings``."""


@kernel
def count_in_air(s, changed):
    """See ``count_partings``."""
    rest = changed & load_integer(s.k, at.FLYING_BALLS)
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        times = load_integer(s.k, at.PARTINGS + i) + 1
        store_integer(s.k, at.PARTINGS + i, times)
        if times > PERCHED_AFTER and load(s.w, at.Z + i) > 0.0:
            store_integer(s.k, at.PERCHED_BALLS, load_integer(s.k, at.PERCHED_BALLS) | 1 << i)


count_partings = by_table(count_none, count_in_air)
"""``count_partings(s, changed)``: count which flying balls step 3 has parted; one parted too often is perched."""


@small_kernel
def lands_nowhere(_s, _i):
    """See ``is_landing``."""
    return False


@small_kernel
def is_at_cloth(s, i):
    """See ``is_landing``."""
    return any_flies(s, 1 << i) and load(s.w, at.Z + i) == 0.0


is_landing = by_table(lands_nowhere, is_at_cloth)
"""``is_landing(s, i)``: whether a flying ball is at the cloth, which has its say then."""
