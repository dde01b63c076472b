"""Tables, scenes and strokes handed to both engines."""

from collections.abc import Mapping
from typing import overload

import numpy as np
from support.compare import UNRECORDED, Happening
from support.scenes import LENGTH, RADIUS, WIDTH, Position, clear, placeable
from support.truth.model import RealWorld, World
from support.truth.strike import Stroke

import physics

SAME_NAMES = (
    *("width", "length", "corner_mouth", "side_mouth", "cue_mass", "mu_slide", "mu_roll", "mu_spin"),
    *("mu_ball", "e_ball", "cushion_parallel", "cushion_perpendicular", "cushion_spin"),
)


REAL_NAMES = (
    *("nose_height", "corner_cut", "side_cut", "corner_shelf", "side_shelf", "corner_hole_radius", "side_hole_radius"),
    *("horn_radius", "cushion_width", "ball_mass", "cue_end_mass", "mu_tip", "e_tip", "cushion", "e_cushion"),
    *("mu_cushion", "ball", "flight", "e_cloth", "e_strike", "e_pressed", "e_rail", "mu_rail", "rail_width"),
)


@overload
def world_of(table: physics.RealTable) -> RealWorld: ...
@overload
def world_of(table: physics.Table) -> World: ...
def world_of(table: physics.Table) -> World:
    """The truth engine's constants for a table of the engine under test."""
    values = table.to_dict()
    if isinstance(table, physics.RealTable):
        return RealWorld(**{name: values[name] for name in (*SAME_NAMES, *REAL_NAMES)})
    return World(historical=values["collisions"] == "fastfiz", **{name: values[name] for name in SAME_NAMES})


def open_table(**changes: object) -> physics.Table:
    """The default table without the test of the cue: every stroke is played."""
    return physics.Table.olympiad().replace(cue_test=False, **changes)


def shot_of(stroke: Stroke) -> physics.Shot:
    return physics.Shot(stroke.v, stroke.phi, stroke.theta, stroke.a, stroke.b)


def run(table: physics.Table, positions: Mapping[int, Position], stroke: Stroke, **options: bool) -> physics.Result:
    return physics.simulate(table, physics.TableState.from_positions(positions), shot_of(stroke), **options)


def mid_game(rng: np.random.Generator, n_balls: int) -> dict[int, Position]:
    """Balls anywhere on the table, none touching."""
    places: list[Position] = []
    while len(places) < n_balls:
        x, y = float(rng.uniform(RADIUS, WIDTH - RADIUS)), float(rng.uniform(RADIUS, LENGTH - RADIUS))
        if placeable(x, y) and clear(places, x, y):
            places.append((x, y))
    return dict(enumerate(places))


def stroke_at(rng: np.random.Generator, positions: Mapping[int, Position], v_max: float = 6.0) -> Stroke:
    """A stroke roughly at one of the object balls, with side, height and elevation."""
    cue, target = positions[0], positions[int(rng.integers(1, len(positions)))]
    aim = np.degrees(np.arctan2(target[1] - cue[1], target[0] - cue[0]))
    a, b = rng.normal(0.0, 4.0, 2)
    return Stroke(
        float(rng.uniform(0.5, v_max)), float(aim + rng.normal(0, 3)), float(rng.uniform(0, 20)), float(a), float(b)
    )


def from_kernel(result: physics.Result) -> list[Happening]:
    return [
        Happening(
            e.time,
            e.kind.value,
            e.ball,
            e.other,
            {s.ball: (complex(*s.position), complex(*s.velocity)) for s in e.states},
        )
        for e in result.events
        if e.kind.value not in UNRECORDED
    ]
