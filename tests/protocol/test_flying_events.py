"""Events of a table that flies are messages as any others."""

import physics
from protocol.outcomes import EventView

FLYING = physics.Table.nine_foot().replace(flight=True)


def test_every_event_of_a_jump_off_the_table_is_a_message():
    state = physics.TableState.from_positions({0: (0.3, 1.0), 3: (0.9, 1.2)})
    result = physics.simulate(FLYING, state, physics.Shot(6.0, 180.0, 40.0))
    views = [EventView.of(event) for event in result.events]
    assert [view.kind for view in views] == [event.kind.value for event in result.events]
    assert {state.motion for view in views for state in view.states} >= {"flying", "driven_off"}
