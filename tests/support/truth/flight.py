"""Flight by itself (FLIGHT, 2.1-2.3, 2.8): the impact law of fixed bodies, launch, landing, rail top, fall."""

from mpmath import mp, mpc, mpf
from support.truth.model import Ball, RealWorld, World
from support.truth.space import UP, Space, cross, inner, plus, size, spin, velocity

NO_SLIP = mpf("1e-12")
SOFT = mpf("1e-3")


def impact(world: RealWorld, v: Space, w: Space, n: Space, e: mpf, mu: mpf) -> tuple[Space, Space]:
    """F1: normal restitution, Coulomb friction, at most sticking."""
    if inner(v, n) >= 0:
        return v, w
    push = -(1 + e) * inner(v, n)
    s = plus(plus(v, n, -inner(v, n)), cross(w, n), -world.radius)
    rub = min(mu * push, 2 * size(s) / 7) / size(s) if size(s) > NO_SLIP else mpf(0)
    return plus(plus(v, n, push), s, -rub), plus(w, cross(n, s), 5 * rub / (2 * world.radius))


def fall(world: RealWorld, ball: Ball, e: mpf, mu: mpf) -> None:
    """On something level; plastic where the rebound would be slower than LIFT."""
    bounces = -e * ball.rise >= world.lift
    v, w = impact(world, velocity(ball), spin(ball), UP, e if bounces else mpf(0), mu)
    ball.velocity, ball.rise = v[0], v[1] if bounces else mpf(0)
    ball.w_xy, ball.w_z = w


def pressed_up(world: RealWorld, speed: mpf) -> mpf:
    return world.e_pressed * speed if world.e_pressed * speed > world.lift else mpf(0)


def meet_cloth(world: RealWorld, ball: Ball, time: mpf) -> None:
    """A landing: frictionless if a nose has just pressed the ball down."""
    if time < ball.pressed:
        ball.rise = pressed_up(world, -ball.rise)
    elif -ball.rise <= SOFT:
        ball.rise = mpf(0)
    else:
        fall(world, ball, world.e_cloth, world.mu_slide)


def leave_cloth(world: RealWorld, ball: Ball) -> None:
    """What the cloth makes of a strike."""
    if ball.rise < 0:
        fall(world, ball, world.e_strike, world.mu_slide)
    elif ball.rise <= world.lift:
        ball.rise = mpf(0)


def keep_down(world: RealWorld, ball: Ball) -> None:
    """A ball on the cloth that is lifted by LIFT or less stays."""
    if ball.height == 0 and 0 < ball.rise <= world.lift:
        ball.rise = mpf(0)


def is_airborne(ball: Ball) -> bool:
    return ball.height > 0 or ball.rise != 0


def fall_time(world: World, ball: Ball) -> mpf:
    return (ball.rise + mp.sqrt(ball.rise**2 + 2 * world.gravity * ball.height)) / world.gravity


def rise_path(world: World, ball: Ball, time: mpf) -> tuple[mpf, mpf, mpf]:
    """Height from ``time`` on as c + b t + a t^2."""
    if not is_airborne(ball):
        return mpf(0), mpf(0), mpf(0)
    t, half = time - ball.since, -world.gravity / 2
    return ball.height + ball.rise * t + half * t * t, ball.rise + 2 * half * t, half


def fly(world: World, ball: Ball, t: mpf) -> None:
    ball.position += ball.velocity * t
    ball.height += ball.rise * t - world.gravity / 2 * t * t
    ball.rise -= world.gravity * t


def air_friction(world: World, pair: tuple[Ball, Ball], n: Space, j_normal: mpf, shared: int, mu: "mpf") -> Space:
    """F2's friction on ball 1 per mass, the vertical part kept; ``mu`` of a slip."""
    one, two = pair
    v = plus(velocity(one), velocity(two), mpf(-1))
    w = plus(spin(one), spin(two), mpf(1))
    s = plus(plus(v, n, -inner(v, n)), cross(n, w), -world.radius)
    if size(s) == 0:
        return mpc(0), mpf(0)
    scale = -min(mu(size(s)) * j_normal, size(s) / (7 * shared)) / size(s)
    return s[0] * scale, s[1] * scale
