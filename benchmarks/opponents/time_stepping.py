"""Simulation by time steps, the method the seed paper compares itself with: move all, look for overlaps, resolve them.

Balls move along their closed forms and change their motion state at the right time even within a step, so ``dt`` is
only what finds contacts. That is kinder than the usual integrator.
"""

import math

from benchmarks.opponents.laws import (
    POCKETED,
    RADIUS,
    RESTING,
    SPINNING,
    acceleration,
    boundary,
    classify,
    collide,
    compiled,
    end_motion,
    move,
    rebound,
)


@compiled
def advance(ball, motion, dt):
    """Move a ball by ``dt`` through its motion states; the state it is in then."""
    while dt > 0.0 and motion != RESTING and motion != POCKETED:
        ax, ay, lasts = acceleration(ball, motion)
        step = min(dt, lasts)
        move(ball, motion, ax, ay, step)
        if motion == SPINNING and ball[6] == 0.0:
            return RESTING
        if step < lasts:
            return motion
        motion = end_motion(ball, motion)
        dt -= step
    return motion


@compiled
def shift(ball, dt):
    """Move a ball along its velocity."""
    ball[0] += dt * ball[2]
    ball[1] += dt * ball[3]


@compiled
def since_contact(one, two, dt):
    """How long ago two overlapping balls touched, at most ``dt``, as if they had moved uniformly."""
    x, y = two[0] - one[0], two[1] - one[1]
    vx, vy = two[2] - one[2], two[3] - one[3]
    speed, towards = vx * vx + vy * vy, x * vx + y * vy
    inside = towards * towards - speed * (x * x + y * y - 4.0 * RADIUS * RADIUS)
    return min(dt, (towards + math.sqrt(inside)) / speed)


@compiled
def resolve_pair(balls, motion, i, j, dt, back_up):
    """Collide two balls if they overlap and approach."""
    x, y = balls[j, 0] - balls[i, 0], balls[j, 1] - balls[i, 1]
    if x * x + y * y > 4.0 * RADIUS * RADIUS:
        return
    if (balls[j, 2] - balls[i, 2]) * x + (balls[j, 3] - balls[i, 3]) * y >= 0.0:
        return
    ago = since_contact(balls[i], balls[j], dt) if back_up else 0.0
    shift(balls[i], -ago)
    shift(balls[j], -ago)
    collide(balls[i], balls[j])
    shift(balls[i], ago)
    shift(balls[j], ago)
    motion[i], motion[j] = classify(balls[i]), classify(balls[j])


@compiled
def resolve_boundary(balls, motion, i, dt, back_up):
    """Pocket a ball that is beyond a mouth; let one beyond a cushion rebound."""
    gap, nx, ny, mouth = boundary(balls[i])
    speed = balls[i, 2] * nx + balls[i, 3] * ny
    if gap >= 0.0 or speed <= 0.0:
        return
    if mouth:
        motion[i] = POCKETED
        return
    ago = min(dt, -gap / speed) if back_up else 0.0
    shift(balls[i], -ago)
    rebound(balls[i], nx)
    shift(balls[i], ago)
    motion[i] = classify(balls[i])


@compiled
def simulate(balls, motion, horizon, dt, back_up):
    """Carry ``balls`` (n, 7) and ``motion`` (n,) to ``horizon`` (s) in steps of ``dt``; both are overwritten."""
    n = len(balls)
    for _ in range(round(horizon / dt)):
        for i in range(n):
            motion[i] = advance(balls[i], motion[i], dt)
        for i in range(n):
            if motion[i] != POCKETED:
                for j in range(i + 1, n):
                    if motion[j] != POCKETED:
                        resolve_pair(balls, motion, i, j, dt, back_up)
                if motion[i] > SPINNING:
                    resolve_boundary(balls, motion, i, dt, back_up)
