"""Sine and cosine of an angle in degrees by a fixed sequence of + - * /.

The platform's library gives different last bits on different machines; this does not. Reduction is exact, values
are exactly 0 and 1 at multiples of 90 deg, exactly equal at 45, odd and even exactly, and within 1 ulp
otherwise. Polynomials: the minimax coefficients of FreeBSD msun k_sin.c and k_cos.c (Sun Microsystems, 1993),
valid on [-pi/4, pi/4], with the tail of the argument taken into account.

Plain functions, so that a table's geometry needs no compiler; ``trigonometry`` makes kernels of them.
"""

import math

DEGREE_HIGH = 0.017453292519943295
DEGREE_LOW = 2.9486522708701687e-19
"""pi/180 = DEGREE_HIGH + DEGREE_LOW to 106 bits."""

SPLIT = 134217729.0
"""2^27 + 1: Veltkamp's constant, which splits a double into two halves whose products are exact."""

HALF_ROOT = 0.7071067811865476
"""sqrt(1/2)."""


def radians_of(degrees: float) -> tuple[float, float]:
    """Radians of an angle in degrees as (high, low), whose sum is good to about 100 bits (Dekker 1971)."""
    high = degrees * DEGREE_HIGH
    scaled = degrees * SPLIT
    d_high = scaled - (scaled - degrees)
    d_low = degrees - d_high
    scaled = DEGREE_HIGH * SPLIT
    c_high = scaled - (scaled - DEGREE_HIGH)
    c_low = DEGREE_HIGH - c_high
    error = ((d_high * c_high - high) + d_high * c_low + d_low * c_high) + d_low * c_low
    return high, error + degrees * DEGREE_LOW


def sine_of(x: float, tail: float) -> float:
    """sin(x + tail) for |x| <= pi/4 (k_sin.c)."""
    z = x * x
    v = z * x
    r = 8.33333333332248946124e-03 + z * (
        -1.98412698298579493134e-04
        + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))
    )
    return x - ((z * (0.5 * tail - v * r) - tail) - v * -1.66666666666666324348e-01)


def cosine_of(x: float, tail: float) -> float:
    """cos(x + tail) for |x| <= pi/4 (k_cos.c)."""
    z = x * x
    r = z * (
        4.16666666666666019037e-02
        + z
        * (
            -1.38888888888741095749e-03
            + z
            * (
                2.48015872894767294178e-05
                + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))
            )
        )
    )
    half = 0.5 * z
    w = 1.0 - half
    return w + (((1.0 - w) - half) + (z * r - x * tail))


def sine_cosine(degrees: float) -> tuple[float, float]:
    """(sin, cos) of a finite angle in degrees."""
    angle = abs(degrees)
    if angle >= 360.0:
        angle %= 360.0  # exact, but a slow library call
    quarter = math.floor(angle / 90.0 + 0.5)
    rest = angle - 90.0 * quarter
    size = abs(rest)
    if size == 45.0:
        sine = HALF_ROOT
        cosine = HALF_ROOT
    else:
        high, low = radians_of(size)
        sine = sine_of(high, low)
        cosine = cosine_of(high, low)
    if rest < 0.0:
        sine = -sine
    if quarter == 1:
        sine, cosine = cosine, -sine
    elif quarter == 2:
        sine, cosine = -sine, -cosine
    elif quarter == 3:
        sine, cosine = -cosine, sine
    if degrees < 0.0:
        sine = -sine
    return sine + 0.0, cosine + 0.0
