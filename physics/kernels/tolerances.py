"""Tolerances of the kernels, each with its unit, human size and what breaks when it changes.

``docs/physics.md`` states the contact rule they belong to; ``benchmarks/`` measures what each one changes.
"""

TOUCH = 1e-12
"""m. Two balls, or a ball and a cushion, closer than this touch. A hundredth of an atom: a thousand times the
rounding of a position (1e-15 m), so simultaneous contacts are seen as such; larger would join separate ones."""

DEEPER = 0.125 * TOUCH
"""m. Balls that touch and neither approach nor open are next looked for this much deeper. Far above the rounding of a
position (1e-15 m), and small enough that several in a row stay within TOUCH."""

SLOW_APPROACH = 1e-9
"""m/s. Touching balls that approach no faster are left alone (30 micrometres an hour). Smaller, and the rounding of
velocities (1e-15 m/s) starts collisions; larger, and resting balls visibly sink into each other."""

SOFT_CUSHION = 1e-3
"""m/s. A cushion stops a ball that comes no faster instead of bouncing it, without friction. Without it an
approach of 1e-16 m/s would cost a ball frozen to a cushion 10 % of its speed and 90 % of its spin."""

ROUNDING_ACROSS = 1e-14
"""m/s. So much of a speed or a slip across a slanted wall may be the rounding of one along it (20 m/s have 4e-15).
Smaller, and a ball held at a facing would be held again for ever; in 10 s it comes nearer by 1e-13 m."""

PRESSING = 1e-14
"""m/s^2. Touching balls whose relative acceleration presses them together no harder are not pressed: over the 10 s of
a shot that is 5e-13 m."""

UNFELT = 1e-16
"""m/s^2. Half an acceleration that does not bring a ball back to a nose that it leaves or runs along: the rounding of
one along it. In the 17 s that the fastest ball rolls it comes nearer by 3e-14 m; at 5e-15, by 1.5e-12 m."""

PARTING_SLACK = 1e-12
"""m/s. After step 3 of the contact rule a pair may open by so much less than it should, or close by so much. Smaller,
and the rounding of velocities (1e-15 m/s) asks for another round for ever; at SLOW_APPROACH, balls of a row sank
1e-10 m into each other."""

PARTING_SHARE = 1.0625
"""A pair is given this much of the speed that keeps it apart for the rest time. Where parting a ball that creeps turns
its friction, so that the pair is pressed harder than before, rounds of 1 came nearer by 1e-10 m/s for ever."""

STOP_BELOW = 0.5
"""A cluster whose energy would have to fall below this share of itself stops instead."""

STILL = 1e-11
"""m/s. A ball that the contact rule leaves with no more energy than this speed has lies still: 0.3 mm a year. Without
it such a ball, pushed anew by its neighbour whenever it began to roll, made a million events in 60 ms; and a touching
neighbour is looked at again before it is 1e-12 m deeper."""

LIFT = 0.05
"""m/s. A rebound from cloth or rail top that is slower is none: the ball stays down, and the impact is plastic. That is
a hop of 0.13 mm lasting 10 ms, thinner than the cloth. Where a ball goes does not depend on it: the friction of the
hops left out is that of sliding for as long (docs/physics.md, eq. 46)."""

PRESS_TIME = 5e-3
"""s. A ball that a nose has pressed down does not bounce if it lands so soon: the nose still holds it (choice)."""

RAIL_CAP = 0.0406
"""m. A ball that leaves a hole towards the rail with its lowest point below this height is caught by the pocket's
liner: cap of a rail with a K-66 cushion (choice)."""

PERCHED_AFTER = 2000
"""Partings by step 3 of the contact rule after which a ball in the air is perched: a wedge of balls and cushion holds
it, and it would be parted a thousand times a second for ever. A ball that comes down takes a few hundred."""

STEPS_PER_EVENT = 4
"""Steps of the event loop (events, and looks again) for each event that the limit allows, after which a shot ends with
``Status.EVENT_LIMIT``."""

ROUND_LIMIT = 10_000
"""Rounds of the contact rule at one instant after which a shot ends with ``Status.EVENT_LIMIT``."""

SOLVER_STEPS = 200
"""Steps of the contact solver: 3 are usual, a graze takes up to 40. At the cap the contact is taken where it stands,
at a gap far below ``TOUCH``."""

ROOT_RESIDUAL = 2e-17
"""m^2. |d|^2 - (2R)^2 at which a contact counts as reached: a gap of 2e-16 m, the rounding of d itself."""

GRAZE = 1.0 + 1e-13
"""Factor of a squared distance: 3e-15 m at a ball's diameter, above the rounding of a path's distance on any table."""

SETTLED_STEPS = 8
"""Newton's steps back to where balls that touched, and have parted, meet. At the cap, or where they lead away, the
contact is taken DEEPER than the balls are: 1.25e-13 m later."""
