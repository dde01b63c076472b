"""The strike of a cue whose end has mass: squirt, and the tip's friction with the miscue beyond it.

A cue of mass M lengthwise and m_e crosswise meets the ball off centre; its end is pushed aside and the ball the other
way. After Alciatore TP A-31 and Shepard 2001 (docs/physics.md, eq. 38-42), with offsets a, b, depth c, C = cos theta,
S = sin theta, E = m_e/m, e_v = S d + C k, everything per ball mass::

    kappa = (c C + b S)/R      g = b C - c S      s^2 = (a^2 + g^2)/R^2      Y = 1 + E (1 + 5/2 kappa^2)
    F = (1 + e_t) V / (1 + m/M + 5/2 s^2 (1 + E)/Y)
    v = F { C d - S k - 5 kappa E/(2 Y R) (-a l + g e_v) }
    w = 5 F/(2 R^2) ((1 + E)/Y) (a e_v + g l)

The tip holds while its impulse stays within the cone of friction, s - kappa tau <= mu_tip (kappa + s tau) with
tau = 5/2 kappa s E/Y; beyond it the impulse lies on the cone.
"""

import math

from physics.kernels.compiling import small_kernel


@small_kernel
def in_frame(aim, forward, left, up):
    """Components (x, y, z) of a vector given along d, l and k."""
    dx, dy = aim[0], aim[1]
    return forward * dx - left * dy, forward * dy + left * dx, up


@small_kernel
def struck(radius, aim, depth, a, b, mass_ratio, end_ratio, e_tip, mu_tip, v):
    """Velocity (3,) m/s and spin (3,) rad/s of the struck ball, and whether the tip slipped.

    ``aim`` from ``strike.direction``; ``depth``, ``a``, ``b`` m; ``mass_ratio`` m/M; ``end_ratio`` m_e/m; ``v`` m/s.
    """
    cos_theta, sin_theta = aim[2], aim[3]
    kappa = (depth * cos_theta + b * sin_theta) / radius
    g = b * cos_theta - depth * sin_theta
    offset = math.sqrt(a * a + g * g)
    s = offset / radius
    y = 1.0 + end_ratio * (1.0 + 2.5 * kappa * kappa)
    tau = 2.5 * kappa * s * end_ratio / y
    # Of the impulse F: aside, along -a l + g e_v over R; and the share that turns the ball.
    aside = 2.5 * kappa * end_ratio / y
    turning = (1.0 + end_ratio) / y
    inverse = 1.0 + mass_ratio + 2.5 * s * s * turning
    slips = end_ratio > 0.0 and s - kappa * tau > mu_tip * (kappa + s * tau)
    if slips:
        tau = (s - mu_tip * kappa) / (kappa + mu_tip * s)
        aside = tau / s
        turning = 1.0 - kappa * tau / s
        across = 1.0 + 2.5 * kappa * kappa + 1.0 / end_ratio
        inverse = 1.0 + mass_ratio + 2.5 * s * s - 5.0 * s * kappa * tau + across * tau * tau
    force = (1.0 + e_tip) * v / inverse
    off_x, off_v = -a / radius * aside, g / radius * aside
    velocity = in_frame(aim, cos_theta - off_v * sin_theta, -off_x, -sin_theta - off_v * cos_theta)
    turn = 2.5 * force / (radius * radius) * turning
    spin = in_frame(aim, turn * a * sin_theta, turn * g, turn * a * cos_theta)
    return (force * velocity[0], force * velocity[1], force * velocity[2]), spin, slips
