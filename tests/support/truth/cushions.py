"""Cushion laws of tables with jaws at any precision: ``han`` and ``mathavan``, for a wall of any direction.

Vectors in space are (plane part as a complex number, vertical part). ``mathavan`` is integrated in the steps the
documentation names, 200 for the approach: it is a method, not a closed form.
"""

from mpmath import mp, mpc, mpf
from support.truth.flight import NO_SLIP, impact, pressed_up
from support.truth.model import Ball, RealWorld, dot
from support.truth.space import Space, cross, inner, plus, size

STEPS = 200


def nose_normal(world: RealWorld, inward: mpc) -> Space:
    """From the nose to the centre: down by h - R over R."""
    return inward * world.rho / world.radius, -(world.nose_height - world.radius) / world.radius


def slip_at(world: RealWorld, v: Space, w: Space, n: Space) -> Space:
    """v - v_n n - R w x n."""
    return plus(plus(v, n, -inner(v, n)), cross(w, n), -world.radius)


def han(world: RealWorld, ball: Ball, inward: mpc) -> None:
    """F1 at the nose; the vertical speed is taken up by the cloth, or comes back by ``e_pressed`` where balls fly."""
    n, v, w = nose_normal(world, inward), (ball.velocity, mpf(0)), (ball.w_xy, ball.w_z)
    (ball.velocity, up), (ball.w_xy, ball.w_z) = impact(world, v, w, n, world.e_cushion, world.mu_cushion)
    if world.flight:
        ball.rise = pressed_up(world, -up) if up < 0 else up


def mathavan(world: RealWorld, ball: Ball, inward: mpc) -> None:
    n = nose_normal(world, inward)
    state = (ball.velocity, mpf(0)), (ball.w_xy, ball.w_z)
    before = kinetic(world, state)
    speed = inner(state[0], n)
    push = -speed / (STEPS * dot(n[0], n[0]))
    state, work = compressed(world, state, n, push)
    state = restored(world, state, n, push, world.e_cushion**2 * work)
    keep = min(mpf(1), mp.sqrt(before / kinetic(world, state)))
    ball.velocity, ball.w_xy, ball.w_z = keep * state[0][0], keep * state[1][0], keep * state[1][1]


State = tuple[Space, Space]


def kinetic(world: RealWorld, state: State) -> mpf:
    return inner(state[0], state[0]) + mpf(2) / 5 * world.radius**2 * inner(state[1], state[1])


def compressed(world: RealWorld, state: State, n: Space, push: mpf) -> tuple[State, mpf]:
    work, speed = mpf(0), inner(state[0], n)
    while True:
        after = step(world, state, n, push)
        speed_after = inner(after[0], n)
        if speed_after >= 0:
            part = speed / (speed - speed_after) * push
            return step(world, state, n, part), work - speed * part / 2
        work -= (speed + speed_after) * push / 2
        state, speed = after, speed_after


def restored(world: RealWorld, state: State, n: Space, push: mpf, work: mpf) -> State:
    speed = max(inner(state[0], n), mpf(0))
    while work > 0:
        after = step(world, state, n, push)
        speed_after = max(inner(after[0], n), mpf(0))
        given = (speed + speed_after) * push / 2
        if given >= work:
            return step(world, state, n, work / given * push)
        work -= given
        state, speed = after, speed_after
    return state


def step(world: RealWorld, state: State, n: Space, push: mpf) -> State:
    middle = pushed(world, state, state, n, push / 2)
    return pushed(world, state, middle, n, push)


def limited(most: mpf, slip: mpf) -> mpf:
    return min(most, 2 * slip / 7) / slip if slip > NO_SLIP else mpf(0)


def pushed(world: RealWorld, state: State, at: State, n: Space, push: mpf) -> State:
    """A normal impulse at the nose, its friction, and the cloth's; what is vertical goes."""
    v, w = at
    s = slip_at(world, v, w, n)
    f = plus((mpc(0), mpf(0)), s, -limited(world.mu_cushion * push, size(s)))
    u = v[0] + world.radius * 1j * w[0]
    g = -limited(world.mu_slide * max(mpf(0), -(push * n[1] + f[1])), abs(u)) * u
    turn = -5 / (2 * world.radius)
    velocity = state[0][0] + push * n[0] + f[0] + g
    spin = plus(plus(state[1], cross(n, f), turn), (1j * g, mpf(0)), turn)
    return (velocity, mpf(0)), spin
