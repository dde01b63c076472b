"""The contact rule of the consistent set (PHYSICS "Contacts"): one instant of a touching cluster, in rounds.

Each round acts from one common set of velocities; nothing depends on ball numbers.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import compress

from mpmath import mpc, mpf
from support.truth.air import Edge, half_towards, stop_at
from support.truth.detect import Boundary
from support.truth.flight import is_airborne, keep_down, meet_cloth
from support.truth.laws import apply_friction, bounce, settle, tangential_impulse
from support.truth.model import Ball, RealWorld, World, dot, energy, real
from support.truth.motion import acceleration, classify
from support.truth.octagon import Line
from support.truth.rails import Wall, kind_at, number_at
from support.truth.space import Space, inner, normal, offset, plus, push, size, velocity

MIN_CLOSING = mpf("1e-14")
"""Two touching balls that close with less than this acceleration (m/s^2) do not press on each other."""

PARTING_SLACK = mpf("1e-12")
"""A pair that opens slower than it should, or closes, by less (m/s) is left: a chain of balls gets there by halves."""

PARTING_SHARE = mpf("1.0625")
"""Of A tau / 2, what a pressed pair is given."""

STILL = mpf("1e-11")
"""m/s. A ball that the rule leaves with no more energy than that of this speed lies still."""

Pair = tuple[Ball, Ball]


@dataclass
class Cluster:
    """Touching balls at one instant, their contacts, and what happened between them."""

    world: World
    balls: list[Ball]
    pairs: list[Pair]
    walls: list[tuple[Ball, Line | Wall | Edge]]
    acted: list[tuple[str, int, int]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.allowed: mpf | None = None
        self.landing = {ball.number for ball in self.balls if goes_down(ball)}
        self.classified = {ball.number: movement(ball) for ball in self.balls}

    def most_energy(self) -> mpf:
        """Set by `limit_from_now` before anything asks."""
        assert self.allowed is not None
        return self.allowed

    def note(self, kind: str, first: int, second: int) -> None:
        self.acted.append((kind, first, second))


def movement(ball: Ball) -> tuple[mpc, mpf, mpc, mpf]:
    return ball.velocity, ball.rise, ball.w_xy, ball.w_z


def touching(world: World, one: Ball, two: Ball) -> bool:
    return size(offset(one, two)) - 2 * world.radius <= world.touch


def away(ball: Ball, wall: Line | Wall | Edge) -> mpf:
    """Speed of a ball away from a wall it touches."""
    return inner(velocity(ball), wall.direction) if isinstance(wall, Edge) else dot(ball.velocity, wall.inward)


def goes_down(ball: Ball) -> bool:
    return ball.height == 0 and ball.rise < 0


def make_cluster(world: World, boundary: Boundary, balls: list[Ball]) -> Cluster:
    pairs = [(p, q) for i, p in enumerate(balls) for q in balls[i + 1 :] if touching(world, p, q)]
    walls = [(ball, line) for ball in balls for line in boundary.touched(ball)]
    return Cluster(world, balls, pairs, walls)


def approach(pair: Pair) -> mpf:
    one, two = pair
    return inner(plus(velocity(one), velocity(two), mpf(-1)), normal(one, two))


def linked(pairs: Sequence[Pair]) -> list[list[Pair]]:
    """Groups of pairs connected through shared balls."""
    groups: list[list[Pair]] = []
    for pair in pairs:
        numbers = {ball.number for ball in pair}
        joined = [g for g in groups if any(ball.number in numbers for p in g for ball in p)]
        groups = [g for g in groups if g not in joined]
        groups.append([pair, *(p for g in joined for p in g)])
    return groups


def normal_round(group: Sequence[Pair], gains: Sequence[mpf], bounce: mpf) -> list[mpf]:
    """lambda (1 + e) D, with D the sum of what gives each pair alone its gain of speed; the impulses per mass."""
    change: dict[int, Space] = {}
    nothing = mpc(0), mpf(0)
    balls = {ball.number: ball for pair in group for ball in pair}
    plastic = [gain / 2 for gain in gains]
    for (one, two), half in zip(group, plastic, strict=True):
        n = normal(one, two)
        change[one.number] = plus(change.get(one.number, nothing), n, -half)
        change[two.number] = plus(change.get(two.number, nothing), n, half)
    scale = sum(gain**2 / 2 for gain in gains) / sum(inner(d, d) for d in change.values()) * bounce
    for i, d in change.items():
        push(balls[i], d, scale)
    return [scale * half for half in plastic]


def ball_round(cluster: Cluster, acting: Sequence[Pair]) -> None:
    """Step 1: normal impulses of all approaching pairs, then their friction, all at once."""
    world, struck = cluster.world, []
    for group in linked(acting):
        impulses = normal_round(group, [approach(pair) for pair in group], 1 + world.e_ball)
        struck += list(zip(group, impulses, strict=True))
    share = {ball.number: sum(ball in pair for pair in acting) for pair in acting for ball in pair}
    frictions = [
        tangential_impulse(world, one, two, normal(one, two), j, max(share[one.number], share[two.number]))
        for (one, two), j in struck
    ]
    for ((one, two), _), impulse in zip(struck, frictions, strict=True):
        apply_friction(world, one, two, normal(one, two), impulse)
        cluster.note("ball_collision", *sorted((one.number, two.number)))


def wall_round(cluster: Cluster, acting: Sequence[tuple[Ball, Line | Wall | Edge]]) -> None:
    """Step 2: the cushion law above v_slow, settling below."""
    fast = [-away(ball, line) > cluster.world.v_slow for ball, line in acting]
    for ball, line in compress(acting, fast):
        bounce(cluster.world, ball, line)
        cluster.note(kind_at(line.cushion), ball.number, number_at(line.cushion))
    if not all(fast):
        limit_from_now(cluster)
    for ball, line in compress(acting, (not f for f in fast)):
        settle(cluster.world, ball, line)
        cluster.note("settling", ball.number, line.cushion)


def cloth_round(cluster: Cluster) -> bool:
    """Step 2b: balls that go down onto the cloth; was there any?"""
    falling = [ball for ball in cluster.balls if goes_down(ball)]
    for ball in falling:
        meet_cloth(real(cluster.world), ball, ball.since)
        if ball.number in cluster.landing:
            cluster.landing.remove(ball.number)
            cluster.note("landing", ball.number, -1)
        else:
            cluster.note("settling", ball.number, -1)
    return bool(falling)


def collide(cluster: Cluster, cushions_only: bool = False) -> None:
    """Steps 1 and 2 until nothing approaches faster than v_creep; in step 3 the cushions alone."""
    while True:
        pairs = [] if cushions_only else cluster.pairs
        acting = [pair for pair in pairs if approach(pair) > cluster.world.v_creep]
        hits = [(b, line) for b, line in cluster.walls if -away(b, line) > cluster.world.v_creep]
        if acting:
            ball_round(cluster, acting)
        else:
            if hits:
                wall_round(cluster, hits)
            stay_down(cluster)
            fallen = press_down(cluster) if cushions_only else cloth_round(cluster)
            if not fallen and not hits:
                break
        stay_down(cluster)
    reclassify(cluster)


def stay_down(cluster: Cluster) -> None:
    """A ball that is hardly lifted stays on the cloth."""
    for ball in cluster.balls if isinstance(cluster.world, RealWorld) else ():
        keep_down(real(cluster.world), ball)


def remove_remainder(cluster: Cluster) -> None:
    """What still approaches, by at most v_creep: pairs get their mean normal speed, at cushions it is taken."""
    for (one, two), rest in [(pair, approach(pair)) for pair in cluster.pairs]:
        if rest > 0:
            n = normal(one, two)
            push(one, n, -rest / 2)
            push(two, n, rest / 2)
            cluster.note("contact", one.number, two.number)
    for ball, line in cluster.walls:
        if away(ball, line) < 0:
            stop_at(ball, line) if isinstance(line, Edge) else stop(ball, line)


def stop(ball: Ball, line: Line | Wall) -> None:
    ball.velocity -= dot(ball.velocity, line.inward) * line.inward


def reclassify(cluster: Cluster) -> None:
    """New motion states for the balls whose velocity or spin changed; others end theirs by events of their own."""
    stay_down(cluster)
    for ball in cluster.balls:
        if cluster.classified[ball.number] != movement(ball):
            classify(cluster.world, ball)
            cluster.classified[ball.number] = movement(ball)


def returning_to_wall(world: World, ball: Ball, line: Line | Wall | Edge) -> bool:
    """Its own acceleration would bring the ball back to the cushion within tau; round a horn it parts as it moves."""
    if isinstance(line, Edge):
        half, opening = half_towards(real(world), ball, line), away(ball, line)
        wanted = max(PARTING_SHARE * half * world.rest_time, 2 * world.v_creep)
        return half > 0 and opening < half * world.rest_time and opening < wanted - PARTING_SLACK
    opening, inward = dot(ball.velocity, line.inward), dot(acceleration(world, ball), line.inward)
    if isinstance(line, Wall):
        across = ball.velocity - opening * line.inward
        inward += dot(across, across) / line.bend
    return inward < 0 and opening < -inward * world.rest_time / 2


def closing_acceleration(world: World, pair: Pair) -> mpf:
    """A = -n.(a2 - a1) - |v_t|^2 / (2R)."""
    one, two = pair
    n = normal(one, two)
    relative = plus(velocity(two), velocity(one), mpf(-1))
    across = plus(relative, n, -inner(relative, n))
    pull = inner(n, plus(acceleration_in_space(world, two), acceleration_in_space(world, one), mpf(-1)))
    return -pull - inner(across, across) / (2 * world.radius)


def acceleration_in_space(world: World, ball: Ball) -> Space:
    return acceleration(world, ball), -world.gravity if is_airborne(ball) else mpf(0)


def part_pressed(cluster: Cluster) -> bool:
    """Step 3: settle balls pressed to a cushion, part pairs that would meet again within tau; was there any?"""
    world = cluster.world
    pressed = [(ball, line) for ball, line in cluster.walls if returning_to_wall(world, ball, line)]
    missing = [(pair, missing_speed(world, pair)) for pair in cluster.pairs]
    parted = [(pair, gain) for pair, gain in missing if gain > 0]
    for ball, line in pressed:
        settle(world, ball, line)
        cluster.note("settling", ball.number, line.cushion)
    for group in linked([pair for pair, _ in parted]):
        normal_round(group, [next(gain for other, gain in parted if other is pair) for pair in group], mpf(1))
        for one, two in group:
            cluster.note("contact", one.number, two.number)
    return bool(pressed or parted)


def missing_speed(world: World, pair: Pair) -> mpf:
    """By how much a pair should open faster so as not to meet again within tau, nor now."""
    closing, opening = closing_acceleration(world, pair), -approach(pair)
    wanted = max(PARTING_SHARE * closing * world.rest_time / 2, 2 * world.v_creep)
    meets_again = closing > MIN_CLOSING and opening < closing * world.rest_time / 2
    if meets_again and opening < wanted - PARTING_SLACK:
        return wanted - opening
    return -opening if -opening > PARTING_SLACK else mpf(0)


def total_energy(cluster: Cluster) -> mpf:
    return sum(energy(cluster.world, ball) for ball in cluster.balls)


def resolve(cluster: Cluster) -> None:
    """The whole rule: collide, then part what presses, the energy never above that before the parting."""
    in_air = any(is_airborne(ball) for ball in cluster.balls)
    if in_air:
        limit_from_now(cluster)
    collide(cluster)
    remove_remainder(cluster)
    press_down(cluster)
    reclassify(cluster)
    limit_from_now(cluster)
    while part_pressed(cluster):
        reclassify(cluster)
        if not in_air and total_energy(cluster) > 2 * cluster.most_energy():
            break
        collide(cluster, cushions_only=True)
    limit_energy(cluster, in_air)
    press_down(cluster)
    lay_still(cluster)


def press_down(cluster: Cluster) -> bool:
    """The cloth takes what the parting has left of a motion into it; was there any?"""
    falling = [ball for ball in cluster.balls if goes_down(ball)]
    for ball in falling:
        ball.rise = mpf(0)
    reclassify(cluster)
    return bool(falling)


def lay_still(cluster: Cluster) -> None:
    """What hardly moves stops."""
    for ball in cluster.balls:
        if energy(cluster.world, ball) <= STILL**2 / 2:
            ball.velocity, ball.rise, ball.w_xy, ball.w_z = mpc(0), mpf(0), mpc(0), mpf(0)
    reclassify(cluster)


def limit_from_now(cluster: Cluster) -> None:
    """The energy before the first time a ball is held or a pair parted is the most the cluster may keep."""
    if cluster.allowed is None:
        cluster.allowed = total_energy(cluster)


def limit_energy(cluster: Cluster, in_air: bool) -> None:
    """All velocities and spins times one factor; a cluster that would lose half its energy stops, unless in the air."""
    before, after = cluster.most_energy(), total_energy(cluster)
    if after <= before:
        return
    factor = mpf(0) if after > 2 * before and not in_air else (before / after) ** mpf("0.5")
    for ball in cluster.balls:
        ball.velocity, ball.w_xy, ball.w_z = factor * ball.velocity, factor * ball.w_xy, factor * ball.w_z
        ball.rise *= factor
    reclassify(cluster)
