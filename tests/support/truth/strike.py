"""The cue's strike [I]: velocity and spin it gives the cue ball."""

from dataclasses import dataclass

from mpmath import mp, mpc, mpf
from support.truth.flight import leave_cloth
from support.truth.model import Ball, RealWorld, World
from support.truth.motion import classify
from support.truth.squirt import struck_exactly


@dataclass(frozen=True)
class Stroke:
    """Olympiad units: v m/s, phi and theta degrees, a and b millimetres."""

    v: float
    phi: float
    theta: float = 0.0
    a: float = 0.0
    b: float = 0.0


def strike(world: World, ball: Ball, stroke: Stroke) -> None:
    """F = 2 m V / (1 + m/M + 5/(2 R^2) [a^2 + (b C - c S)^2]) and what follows from it."""
    if isinstance(world, RealWorld):
        strike_with_end_mass(world, ball, stroke)
        return
    a, b, m, radius = mpf(stroke.a) / 1000, mpf(stroke.b) / 1000, world.ball_mass, world.radius
    theta, phi = mp.radians(mpf(stroke.theta)), mpf(stroke.phi) / 180
    cos_theta, sin_theta = mp.cos(theta), mp.sin(theta)
    c = mp.sqrt(radius**2 - a**2 - b**2)
    lever = b * cos_theta - c * sin_theta
    inertia = mpf(2) / 5 * m * radius**2
    bracket = 5 / (2 * radius**2) * (a**2 + lever**2)
    if world.historical:
        bracket *= mpf(0.999425)
        inertia = mpf(0.4) * mpf(0.160) * radius**2 * mpf(0.995473)
    force = 2 * m * mpf(stroke.v) / (1 + m / world.cue_mass + bracket)
    forward = mpc(mp.cospi(phi), mp.sinpi(phi))
    ball.velocity = force * cos_theta / m * forward
    ball.w_xy = force / inertia * (lever * 1j * forward + a * sin_theta * forward)
    ball.w_z = force / inertia * a * cos_theta
    classify(world, ball)


def strike_with_end_mass(world: RealWorld, ball: Ball, stroke: Stroke) -> None:
    """Squirt and miscue; the vertical part is absorbed by the cloth, or answered by it where balls fly."""
    (x, y, z), (p, q, r), _ = struck_exactly(
        *(world.radius, mpf(stroke.phi), mpf(stroke.theta), mpf(stroke.a) / 1000, mpf(stroke.b) / 1000),
        *(world.ball_mass / world.cue_mass, world.cue_end_mass / world.ball_mass, world.e_tip, world.mu_tip),
        mpf(stroke.v),
    )
    ball.velocity, ball.w_xy, ball.w_z = mpc(x, y), mpc(p, q), r
    if world.flight:
        ball.rise = z
        leave_cloth(world, ball)
    classify(world, ball)
