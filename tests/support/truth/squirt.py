"""The strike of a cue with end mass, derived independently of the kernel: as an impulse, not by S1-S3.

The tip gives the ball the impulse per mass J = F (u - tau p): u along the cue, p the direction across it, in the plane
of cue and ball's centre, in which the tip is pushed. While it sticks, the crosswise velocity of the tip's end equals
that of the ball's surface; beyond the cone of friction J lies on the cone. F follows from restitution along J's work.
"""

from mpmath import cos, mp, mpf, radians, sin, sqrt

Vector = tuple[mpf, mpf, mpf]


def cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> mpf:
    return sum(x * y for x, y in zip(a, b, strict=True))


def plus(a: Vector, b: Vector, factor: mpf) -> Vector:
    return tuple(x + factor * y for x, y in zip(a, b, strict=True))


def times(factor: mpf, a: Vector) -> Vector:
    return tuple(factor * x for x in a)


def struck_exactly(
    radius: mpf, phi: mpf, theta: mpf, a: mpf, b: mpf, mass_ratio: mpf, end: mpf, e_tip: mpf, mu_tip: mpf, v: mpf
) -> tuple[Vector, Vector, bool | None]:
    """Velocity, spin, and whether the tip slipped; None where that is decided by the last digits of a double.

    Lengths in m, angles in deg; ``mass_ratio`` m/M, ``end`` m_e/m.
    """
    d = cos(radians(phi)), sin(radians(phi)), mpf(0)
    left, up = (-d[1], d[0], mpf(0)), (mpf(0), mpf(0), mpf(1))
    u = plus(times(cos(radians(theta)), d), up, -sin(radians(theta)))
    depth = sqrt(radius**2 - a**2 - b**2)
    tip = plus(plus(times(-depth, d), left, -a), up, b)  # from the ball's centre
    offset = plus(tip, u, -dot(tip, u))  # crosswise
    arm = sqrt(dot(offset, offset))
    if arm <= radius * mpf(10) ** (5 - mp.dps):  # through the middle: what is left has no direction
        return times(force_of(u, u, tip, radius, mass_ratio, end, e_tip, v), u), (mpf(0),) * 3, False
    p = times(1 / arm, offset)

    def crosswise_slip(tau: mpf) -> mpf:
        """Of the ball's surface against the cue's end along p, per impulse."""
        j = plus(u, p, -tau)
        surface = plus(j, cross(times(1 / (mpf("0.4") * radius**2), cross(tip, j)), tip), mpf(1))
        return dot(surface, p) - tau / end

    tau = mpf(0)
    if end > 0:
        zero, one = crosswise_slip(mpf(0)), crosswise_slip(mpf(1))
        tau = zero / (zero - one)
    normal = times(-1 / radius, tip)
    j = plus(u, p, -tau)
    pressing = dot(j, normal)
    sliding = sqrt(max(dot(j, j) - pressing**2, mpf(0)))
    margin = sliding - mu_tip * pressing
    slips = end > 0 and margin > 0
    decided = abs(margin) > mpf(10) ** -12
    if slips:
        along, aside = dot(u, normal), sqrt(1 - dot(u, normal) ** 2)
        tau = (aside - mu_tip * along) / (along + mu_tip * aside)
        j = plus(u, p, -tau)
    force = force_of(j, u, tip, radius, mass_ratio, end, e_tip, v)
    spin = times(force / (mpf("0.4") * radius**2), cross(tip, j))
    return times(force, j), spin, slips if decided else None


def force_of(j: Vector, u: Vector, tip: Vector, radius: mpf, mass_ratio: mpf, end: mpf, e_tip: mpf, v: mpf) -> mpf:
    """F for the impulse F j: J turns the approach along itself into e_tip times that, as the energy law asks."""
    turned = cross(tip, j)
    crosswise = dot(j, j) - dot(j, u) ** 2
    inverse = dot(j, j) + dot(turned, turned) / (mpf("0.4") * radius**2) + mass_ratio * dot(j, u) ** 2
    if end > 0:
        inverse += crosswise / end
    return (1 + e_tip) * v * dot(j, u) / inverse if mp.isfinite(inverse) else mpf(0)
