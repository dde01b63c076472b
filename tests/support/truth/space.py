"""Vectors in space for the truth engine: a part in the plane as a complex number, and a vertical part."""

from mpmath import mp, mpc, mpf
from support.truth.model import Ball, dot

Space = tuple[mpc, mpf]

UP: Space = (mpc(0), mpf(1))


def cross(a: Space, b: Space) -> Space:
    (p, z), (q, u) = a, b
    return mpc(p.imag * u - z * q.imag, z * q.real - p.real * u), p.real * q.imag - p.imag * q.real


def inner(a: Space, b: Space) -> mpf:
    return dot(a[0], b[0]) + a[1] * b[1]


def plus(a: Space, b: Space, factor: mpf) -> Space:
    return a[0] + factor * b[0], a[1] + factor * b[1]


def size(a: Space) -> mpf:
    return mp.sqrt(inner(a, a))


def velocity(ball: Ball) -> Space:
    return ball.velocity, ball.rise


def spin(ball: Ball) -> Space:
    return ball.w_xy, ball.w_z


def offset(one: Ball, two: Ball) -> Space:
    return two.position - one.position, two.height - one.height


def normal(one: Ball, two: Ball) -> Space:
    """Unit vector from one centre to the other."""
    way = offset(one, two)
    return way[0] / size(way), way[1] / size(way)


def push(ball: Ball, change: Space, factor: float = 1.0) -> None:
    ball.velocity, ball.rise = plus(velocity(ball), change, factor)


def turn(ball: Ball, change: Space, factor: mpf) -> None:
    ball.w_xy, ball.w_z = plus(spin(ball), change, factor)
