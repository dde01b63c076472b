"""Seen: on ``Table.fastfiz()`` shot 2 of the corpus left the record after 31 events, five other breaks likewise.

Expected: two sliding balls that just collided slowly go on as the historical law leaves them. Why they did not: the
contact rule of the consistent set parted them. The corpus itself is compared in ``tests/physics``; this is its
smallest scene: a slow collision of two sliding balls that their accelerations press together.
"""

from support.moving import Launch, let_go

import physics

R = 0.028575


def test_pressed_balls_are_not_parted():
    pressed = {
        1: Launch((0.5, 1.0), (0.005, 0.0), (0.0, 2.0, 0.0)),
        2: Launch((0.5 + 2 * R + 1e-9, 1.0), (0.0, 0.0), (0.0, -2.0, 0.0)),
    }
    historical = let_go(physics.Table.fastfiz(), pressed)
    assert "contact" not in {event.kind.value for event in historical.events}
    assert historical.status is physics.Status.AT_REST
