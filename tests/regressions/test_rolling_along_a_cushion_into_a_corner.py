"""A ball rolls along a cushion into a corner of a table with jaws: the event limit was its end.

The horn is tangent to the line on which the centre rolls. At the north cushion rounding took that tangency for a
meeting with the horn, at which nothing changed, and found it again at the same instant, a million times.
"""

import pytest
from support.moving import let_go, rolling

import physics

NINE = physics.Table.nine_foot().replace(cue_test=False, flight=False)
RHO = NINE.contact_distance
FOUND = [
    (0.4941341035308072, 2.5124862662941307, 180.0, 2.088551278505858, -4.201678140116241),
    (0.738974671298492, 2.5124862662941307, 180.0, 4.16239611916748, 0.0),
    (1.1058833762150335, 2.5124862662941307, 0.0, 5.05361473509813, -18.823682348998258),
]
"""x, y, phi, v, b of strokes that never ended."""


@pytest.mark.parametrize("stroke", FOUND, ids=str)
def test_strokes_that_did_not_end(stroke):
    x, y, phi, v, b = stroke
    state = physics.TableState.from_positions({0: (x, y)})
    result = physics.simulate(NINE, state, physics.Shot(v, phi, b=b), event_limit=1_000)
    assert result.status is physics.Status.AT_REST
    assert result.n_events < 30


@pytest.mark.parametrize("speed", [0.05, 0.7, 2.0, 9.0])
@pytest.mark.parametrize("cushion", ["west", "east", "south", "north"])
@pytest.mark.parametrize("way", [-1.0, 1.0])
def test_along_every_cushion(cushion, way, speed):
    """Nothing is met where the nose ends: the first thing in its way is the far side of the corner."""
    across = {"west": RHO, "east": NINE.width - RHO, "south": RHO, "north": NINE.length - RHO}[cushion]
    for along in (0.31, 0.5, 0.77):
        if cushion in ("west", "east"):
            ball = rolling((across, 1.5 + along / 4 if way > 0 else 1.0 - along / 4), (0.0, way * speed))
        else:
            ball = rolling((along, across), (way * speed, 0.0))
        result = let_go(NINE, {1: ball})
        assert result.status is physics.Status.AT_REST
        met = [event for event in result.events if event.kind.value in ("jaw_collision", "rail_collision")]
        for event in met[:1]:
            x, y = event.states[0].position
            near = min(x, NINE.width - x) if cushion in ("south", "north") else min(y, NINE.length - y)
            assert near < 0.03
