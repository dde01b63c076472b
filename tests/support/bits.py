"""Bits of a fixed set of shots: ``python -m support.bits`` prints a hash of every result, one line a scene.

Run in processes with other numba settings, it shows whether they change a bit. The inputs are rounded, so that they
are the same wherever this runs.
"""

import hashlib
import sys
from collections.abc import Iterator

import numpy as np
from support.scenes import RADIUS
from support.worlds import mid_game, stroke_at

import physics

Play = tuple[str, physics.Table, physics.TableState, physics.Shot]


def plays() -> Iterator[Play]:
    """Breaks, mid-game shots, touching and frozen scenes, all tables; the first ones are the cheapest."""
    rng = np.random.default_rng(99)
    consistent = physics.Table.olympiad().replace(cue_test=False)
    for n in (2, 5, 9, 16):
        positions = {ball: (round(x, 9), round(y, 9)) for ball, (x, y) in mid_game(rng, n).items()}
        s = stroke_at(rng, positions)
        shot = physics.Shot(*(round(value, 6) for value in (s.v, s.phi, s.theta, s.a, s.b)))
        state = physics.TableState.from_positions(positions)
        yield f"mid-game, {n} balls", consistent, state, shot
        yield f"mid-game, {n} balls, historical", physics.Table.fastfiz(), state, shot
    row = {0: (0.5, 1.5), **{i: (0.5, 1.2 - 2 * i * RADIUS) for i in range(1, 5)}}
    frozen = {0: (0.5, 0.8), 1: (0.5, RADIUS), 2: (0.5 + 2 * RADIUS, RADIUS), 3: (RADIUS, 0.6)}
    yield "row", consistent, physics.TableState.from_positions(row), physics.Shot(2.0, 270.0, 0.0, 1.0, 5.0)
    yield "frozen", consistent, physics.TableState.from_positions(frozen), physics.Shot(3.0, 268.0, 3.0)
    lossy = consistent.replace(e_ball=0.9, mu_ball=0.2)
    yield "frozen, lossy", lossy, physics.TableState.from_positions(frozen), physics.Shot(3.0, 268.0, 3.0)
    for gap in (None, 0.0):
        state = physics.rack(consistent, "eight_ball", seed=3, gap=gap)
        yield f"break, gap {gap}", consistent, state, physics.Shot(9.0, 269.7, 4.0, 2.0, 3.0)
    yield from plays_with_jaws()


def plays_with_jaws() -> Iterator[Play]:
    """Tables with jaws: mid-game shots by every law, a rattle, balls in the jaws and frozen to horns, a break."""
    rng, nine = np.random.default_rng(15), physics.RealTable.of_size("nine_foot").replace(cue_test=False, flight=False)
    for cushion, ball in (
        ("han", "alciatore"),
        ("mathavan", "alciatore"),
        ("factors", "consistent"),
        ("han", "fastfiz"),
    ):
        positions = {number: (round(x, 9), round(y, 9)) for number, (x, y) in mid_game(rng, 7).items()}
        s = stroke_at(rng, positions)
        shot = physics.Shot(*(round(value, 6) for value in (s.v, s.phi, s.theta, s.a, s.b)))
        state = physics.TableState.from_positions(positions)
        yield f"nine_foot, {cushion}, {ball}", nine.replace(cushion=cushion, ball=ball), state, shot
    jaws = {0: (0.9, 0.06), 1: (0.02, 0.02), 2: (-0.003, 1.27), 3: (1.25, 2.52), 4: (0.35, 0.3)}
    state = physics.TableState.from_positions(jaws)
    yield "nine_foot, rattle", nine, state, physics.Shot(6.0, 182.5, 0.0, 2.0, 1.0)
    yield "nine_foot, hung balls", nine, state, physics.Shot(3.0, 180.9, 3.0, 0.0, -3.0)
    for size in ("eight_foot", "seven_foot"):
        table = physics.RealTable.of_size(size).replace(cue_test=False, flight=False)
        corner, side = (at_horn(shape, table.contact_distance) for shape in (table.corner_shape, table.side_shape))
        at_horns = {0: (0.5, 0.4), 1: corner, 2: (side[1], 0.5 * table.length + side[0]), 3: corner[::-1]}
        state = physics.TableState.from_positions(at_horns)
        yield f"{size}, frozen to horns", table, state, physics.Shot(4.0, 219.0, 0.0, -3.0, 2.0)
    state = physics.rack(nine, "eight_ball", seed=3)
    yield "nine_foot, break", nine, state, physics.Shot(11.0, 269.7, 4.0, 2.0, 3.0)
    yield from plays_in_flight()


def plays_in_flight() -> Iterator[Play]:
    """Tables that fly: jumps, a jump into touching balls, rails and mouths from the air, hops of hard rail hits."""
    table = physics.RealTable.of_size("nine_foot").replace(cue_test=False, flight=True)
    touching = {1: (0.6, 0.6), 2: (0.6 + 2 * RADIUS, 0.6), 3: (0.6 + RADIUS, 0.6 - 0.0495)}
    scenes = {
        "jump": ({0: (0.6, 0.5), 1: (0.6, 0.8), 2: (0.62, 1.9)}, (3.2, 90.0, 45.0, 0.0, 20.0)),
        "jump into touching balls": ({0: (0.61, 0.9)} | touching, (2.2, 269.5, 50.0, 1.0, 18.0)),
        "over the rail": ({0: (0.333, 0.721), 1: (0.159, 0.83), 2: (0.3, 1.5)}, (9.5, 146.9, 10.0, 0.0, -4.0)),
        "into a mouth": ({0: (0.3, 0.28), 1: (0.02, 0.02)}, (2.4, 222.0, 35.0, 0.0, 12.0)),
        "70 degrees into a frozen ball": ({0: (0.6, 0.8), 1: (0.6, 0.8 - 2 * RADIUS)}, (4.0, 270.0, 70.0, 2.0, 12.0)),
    }
    for name, (positions, shot) in scenes.items():
        yield f"flight, {name}", table, physics.TableState.from_positions(positions), physics.Shot(*shot)
    hopping = table.replace(e_pressed=0.4, e_cloth=0.7)
    yield "flight, hops", hopping, physics.rack(table, "eight_ball", seed=3), physics.Shot(9.0, 269.7, 6.0, 2.0, 3.0)


def at_horn(shape: physics.mouths.Mouth, rho: float) -> tuple[float, float]:
    """(s, d) of a centre that touches a horn."""
    reach = shape.horn_radius + rho
    return shape.nose_end - 0.28 * reach, 0.96 * reach - shape.horn_radius


def digest(play: Play) -> str:
    """SHA-256 over the whole trace and the end of a shot."""
    _, table, state, shot = play
    result = physics.simulate(table, state, shot)
    text = hashlib.sha256(result.final.positions.tobytes())
    for event in result.events:
        numbers = [event.time, event.ball, event.other]
        for ball in event.states:
            numbers += [*ball.position, *ball.velocity, *ball.spin, ball.motion]
            numbers += [ball.height, ball.velocity_z] if ball.flight else []
        text.update(event.kind.value.encode() + np.array(numbers).tobytes())
    return text.hexdigest()


def main(limit: int) -> None:
    for play, _ in zip(plays(), range(limit), strict=False):
        print(f"{digest(play)}  {play[0]}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000)
