"""What the contact rule asks of cushions: ``cushion`` answers for straight mouths, ``rails`` for tables with jaws."""

from physics.kernels.resolve import cushion, rails
from physics.kernels.workspace import by_table

touched_cushion = by_table(cushion.touched, rails.touched)
"""``touched_cushion(s, i)``: number of the cushion or jaw that ball ``i`` touches, or NO_CUSHION."""

speed_towards = by_table(cushion.speed_towards, rails.speed_towards)
"""``speed_towards(s, i, cushion)``: how fast a ball that touches it approaches, m/s."""

rebound = by_table(cushion.rebound, rails.rebound)
"""``rebound(s, i, cushion)``: a collision with it."""

stop = by_table(cushion.stop, rails.stop)
"""``stop(s, i, cushion)``: an approach that is rounding is taken."""

hold = by_table(cushion.hold, rails.hold)
"""``hold(s, i, cushion)``: a soft touch."""

returns_at_once = by_table(cushion.returns, rails.returns)
"""``returns_at_once(s, i, cushion)``: whether its own acceleration brings a ball back to it within the rest time."""

is_leaving = by_table(cushion.leaves, rails.leaves)
"""``is_leaving(s, i, cushion)``: whether a ball that has touched it ever since is leaving it."""

is_same = by_table(cushion.is_same, rails.is_same)
"""``is_same(s, one, other)``: whether two of them count as one cushion."""

report = by_table(cushion.report, rails.report)
"""``report(s, i, cushion, time)``: record a collision with it; its ordinal."""
