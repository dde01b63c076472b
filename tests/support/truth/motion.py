"""Motion between events in closed form [I], and what a ball becomes when its motion ends."""

from mpmath import mp, mpc, mpf
from support.truth.flight import fall_time, fly, is_airborne
from support.truth.model import OUT_OF_PLAY, Ball, Motion, World, slip, unit


def acceleration(world: World, ball: Ball) -> mpc:
    if ball.motion is Motion.SLIDING:
        return -world.mu_slide * world.gravity * unit(slip(world, ball))
    if ball.motion is Motion.ROLLING:
        return -world.mu_roll * world.gravity * unit(ball.velocity)
    return mpc(0)


def spin_decay(world: World, ball: Ball) -> mpf:
    """|d w_z / dt|; the historical engine took a quarter of it while sliding."""
    rate = 5 * world.mu_spin * world.gravity / (2 * world.radius)
    return rate / 4 if world.historical and ball.motion is Motion.SLIDING else rate


def lifetime(world: World, ball: Ball) -> mpf:
    """How long the ball's motion state lasts (s)."""
    if ball.motion is Motion.SLIDING:
        return 2 * abs(slip(world, ball)) / (7 * world.mu_slide * world.gravity)
    if ball.motion is Motion.ROLLING:
        return abs(ball.velocity) / (world.mu_roll * world.gravity)
    if ball.motion is Motion.FLYING:
        return fall_time(world, ball)
    if ball.motion is Motion.SPINNING:
        return abs(ball.w_z) / spin_decay(world, ball)
    return mp.inf


def advance(world: World, ball: Ball, time: mpf) -> None:
    """Move the ball to ``time`` within its motion state."""
    t = time - ball.since
    ball.since = time
    if ball.motion in (Motion.STATIONARY, *OUT_OF_PLAY):
        return
    if ball.motion is Motion.FLYING:
        fly(world, ball, t)
        return
    a = acceleration(world, ball)
    if ball.motion is Motion.SLIDING:
        ball.w_xy += 5 / (2 * world.radius) * t * 1j * -a
    ball.position += ball.velocity * t + a * t * t / 2
    ball.velocity += a * t
    if ball.motion is Motion.ROLLING:
        ball.w_xy = 1j * ball.velocity / world.radius
    left = max(mpf(0), abs(ball.w_z) - spin_decay(world, ball) * t)
    ball.w_z = left * mp.sign(ball.w_z)


def classify(world: World, ball: Ball) -> None:
    """The motion state that follows from velocity and spin."""
    moving = abs(ball.velocity) > world.slip_zero
    sliding = abs(slip(world, ball)) > world.slip_zero
    if is_airborne(ball):
        ball.motion = Motion.FLYING
    elif sliding and (moving or not world.historical):
        ball.motion = Motion.SLIDING
    elif moving:
        ball.motion = Motion.ROLLING
    else:
        rest(ball)


def rest(ball: Ball) -> None:
    ball.velocity = mpc(0)
    ball.w_xy = mpc(0)
    ball.motion = Motion.SPINNING if ball.w_z != 0 else Motion.STATIONARY


def end_of_motion(world: World, ball: Ball) -> str:
    """Let the ball go on to its next motion state; returns the name of the transition."""
    before = ball.motion
    if before is Motion.SLIDING and abs(ball.velocity) > world.slip_zero:
        ball.motion = Motion.ROLLING
        ball.w_xy = 1j * ball.velocity / world.radius
    elif before is Motion.SPINNING:
        ball.w_z = mpf(0)
        rest(ball)
    else:
        rest(ball)
    return f"{before.value}_{ball.motion.value}"
