"""What one collision does: two balls, a cushion; the consistent set and the historical one (PHYSICS "Collisions")."""

from mpmath import exp, mpc, mpf
from support.truth.air import Edge, part_from, rebound
from support.truth.cushions import han, mathavan
from support.truth.flight import air_friction
from support.truth.model import Ball, RealWorld, World, dot, real, unit
from support.truth.motion import classify
from support.truth.octagon import Line
from support.truth.rails import Wall
from support.truth.space import Space, cross


def in_air(one: Ball, two: Ball) -> bool:
    """Whether a pair keeps its vertical part: one of them is off the cloth."""
    return one.height > 0 or two.height > 0


def cross_n(n: mpc, s: Space) -> Space:
    """n x s for a plane unit vector n."""
    plane, vertical = s
    return -1j * n * vertical, n.real * plane.imag - n.imag * plane.real


def contact_slip(world: World, one: Ball, two: Ball, n: mpc) -> Space:
    """v1 - v2 - R n x (w1 + w2), its normal part included."""
    plane, vertical = cross_n(n, (one.w_xy + two.w_xy, one.w_z + two.w_z))
    return one.velocity - two.velocity - world.radius * plane, -world.radius * vertical


def length(s: Space) -> mpf:
    return (dot(s[0], s[0]) + s[1] ** 2) ** mpf("0.5")


def ball_friction(world: World, slip: mpf) -> mpf:
    """Coefficient between two balls: the table's, or Alciatore's, which falls with the slip (TP A-14)."""
    if isinstance(world, RealWorld) and world.ball == "alciatore":
        return mpf("9.951e-3") + mpf("0.108") * exp(-mpf("1.088") * slip)
    return world.mu_ball


def tangential_impulse(world: World, one: Ball, two: Ball, direction: Space, j_normal: mpf, shared: int) -> Space:
    """Friction on ball 1 per mass: against the slip, min(mu J_n, |slip| / (7 shared))."""
    if in_air(one, two):
        return air_friction(world, (one, two), direction, j_normal, shared, lambda slip: ball_friction(world, slip))
    n = direction[0]
    plane, vertical = contact_slip(world, one, two, n)
    tangent = (plane - dot(plane, n) * n, vertical)
    size = length(tangent)
    if size == 0:
        return mpc(0), mpf(0)
    scale = -min(ball_friction(world, size) * j_normal, size / (7 * shared)) / size
    return tangent[0] * scale, tangent[1] * scale


def apply_friction(world: World, one: Ball, two: Ball, direction: Space, impulse: Space) -> None:
    """Opposite impulses, spins changed in the same sense; on the cloth the vertical velocity is absorbed."""
    one.velocity += impulse[0]
    two.velocity -= impulse[0]
    if in_air(one, two):
        one.rise += impulse[1]
        two.rise -= impulse[1]
    plane, vertical = cross(direction, impulse)
    for ball in (one, two):
        ball.w_xy += 5 / (2 * world.radius) * plane
        ball.w_z += 5 / (2 * world.radius) * vertical


def bounce(world: World, ball: Ball, line: Line | Wall | Edge) -> None:
    """A cushion, by its law; ``factors``: parallel 0.9, perpendicular -0.6, all spin x 0.1."""
    if isinstance(line, Edge):
        rebound(real(world), ball, line, ball.since)
        return
    if isinstance(world, RealWorld) and world.cushion != "factors":
        {"han": han, "mathavan": mathavan}[world.cushion](world, ball, line.inward)
        return
    v_n = dot(ball.velocity, line.inward)
    along = ball.velocity - v_n * line.inward
    ball.velocity = world.cushion_parallel * along - world.cushion_perpendicular * v_n * line.inward
    ball.w_xy *= world.cushion_spin
    ball.w_z *= world.cushion_spin


def settle(world: World, ball: Ball, line: Line | Wall | Edge) -> None:
    """A cushion reached too slowly to bounce: no velocity across it, no spin component along it; in the air parted."""
    if isinstance(line, Edge):
        part_from(real(world), ball, line, mpf("1.0625"))
        return
    along = 1j * line.inward
    ball.velocity -= dot(ball.velocity, line.inward) * line.inward
    ball.w_xy -= dot(ball.w_xy, along) * along


def historical_collision(world: World, one: Ball, two: Ball) -> None:
    """FastFiz 0.2, its faults included."""
    if abs(one.velocity) < world.slip_zero:
        one, two = two, one
    n = unit(two.position - one.position)
    both_move = abs(two.velocity) > world.slip_zero
    b_plane, b_vertical = contact_slip(world, one, two, n)
    v1n, v2n = dot(one.velocity, n), dot(two.velocity, n)
    k = mpf(0.01) * v1n / length((b_plane, b_vertical))
    b_tangential = b_plane - dot(b_plane, n) * n
    v1s, v2s = one.velocity - v1n * n, two.velocity - v2n * n
    one.velocity = v2n * n + v1s - k * b_tangential
    two.velocity = v1n * n + v2s + k * b_tangential
    if both_move:
        for ball in (one, two):
            ball.w_xy = 1j * ball.velocity / world.radius
    else:
        factor = -mpf(2.5) * k / (mpf(1.000575) * world.radius)
        plane, vertical = cross_n(n, (b_plane, b_vertical))
        two.w_xy += factor * plane
        two.w_z += factor * vertical
        one.w_xy -= factor * plane
        one.w_z -= factor * vertical
    for ball in (one, two):
        classify(world, ball)
