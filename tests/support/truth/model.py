"""What the truth engine moves: balls in the plane as complex numbers, and the numbers of the table.

A plane vector ``(x, y)`` is the complex number ``x + iy``: turning it left by 90 degrees (``k x v``) multiplies
it by ``i``. Everything is an mpmath number; doubles that come in are taken as exact. Nothing of ``physics`` is used.
"""

from dataclasses import dataclass, field, fields
from enum import Enum

from mpmath import mp, mpc, mpf


class Motion(Enum):
    """The motion states of [I] and the one after the last event of a ball."""

    STATIONARY = "stationary"
    SPINNING = "spinning"
    SLIDING = "sliding"
    ROLLING = "rolling"
    FLYING = "flying"
    POCKETED = "pocketed"
    DRIVEN_OFF = "driven off"


MOVING = (Motion.SLIDING, Motion.ROLLING, Motion.FLYING)
OUT_OF_PLAY = (Motion.POCKETED, Motion.DRIVEN_OFF)


@dataclass
class Ball:
    """A ball at time ``since``: position m, velocity m/s, angular velocity rad/s as ``w_xy`` (plane) and ``w_z``.

    ``height`` m of the centre above where it rests, ``rise`` m/s upwards; ``pressed`` s: until then a nose holds it.
    """

    number: int
    position: mpc
    velocity: mpc = field(default_factory=lambda: mpc(0))
    w_xy: mpc = field(default_factory=lambda: mpc(0))
    w_z: mpf = field(default_factory=lambda: mpf(0))
    motion: Motion = Motion.STATIONARY
    since: mpf = field(default_factory=lambda: mpf(0))
    height: mpf = field(default_factory=lambda: mpf(0))
    rise: mpf = field(default_factory=lambda: mpf(0))
    pressed: mpf = field(default_factory=lambda: -mp.inf)

    def copy(self) -> "Ball":
        return Ball(*(getattr(self, f.name) for f in fields(self)))


@dataclass(frozen=True)
class World:
    """Constants of a table, SI units, as doubles (PHYSICS "Olympiad table and constants", "Contacts")."""

    width: float = 1.116
    length: float = 2.236
    radius: float = 0.028575
    corner_mouth: float = 0.11
    side_mouth: float = 0.12
    gravity: float = 9.81
    ball_mass: float = 0.16301
    cue_mass: float = 0.160 / 0.302631579
    mu_slide: float = 0.2
    mu_roll: float = 0.015
    mu_spin: float = 0.044
    mu_ball: float = 0.01
    e_ball: float = 1.0
    cushion_parallel: float = 0.9
    cushion_perpendicular: float = 0.6
    cushion_spin: float = 0.1
    touch: float = 1e-12
    v_creep: float = 1e-9
    v_slow: float = 1e-3
    tau: float = 1e-3
    historical: bool = False

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if isinstance(value, float):
                object.__setattr__(self, name, mpf(value))

    @property
    def rest_time(self) -> mpf:
        """tau, longer on slower cloths (s)."""
        return self.tau * max(mpf(1), mpf(0.2) / self.mu_slide, mpf(0.015) / self.mu_roll)

    @property
    def slip_zero(self) -> mpf:
        """Slips and speeds up to this count as 0 (m/s)."""
        return mpf("1e-10") if self.historical else mpf("1e-12")

    @property
    def corner(self) -> mpf:
        """The corner mouth's share of each cushion, cp = 0.11 / sqrt 2."""
        return self.corner_mouth / mp.sqrt(2)


@dataclass(frozen=True)
class RealWorld(World):
    """Constants of a table with jaws (FLIGHT, sections 3 and 5)."""

    nose_height: float = 0.03629025
    corner_cut: float = 142.0
    side_cut: float = 104.0
    corner_shelf: float = 0.041275
    side_shelf: float = 0.0047625
    corner_hole_radius: float = 0.0635
    side_hole_radius: float = 0.0635
    horn_radius: float = 0.00635
    cushion_width: float = 0.0508
    cue_end_mass: float = 0.0056699
    mu_tip: float = 0.6
    e_tip: float = 1.0
    cushion: str = "han"
    e_cushion: float = 0.85
    mu_cushion: float = 0.2
    ball: str = "alciatore"
    flight: bool = False
    e_cloth: float = 0.5
    e_strike: float = 0.5
    e_pressed: float = 0.0
    e_rail: float = 0.5
    mu_rail: float = 0.2
    rail_width: float = 0.1397
    lift: float = 0.05
    press_time: float = 5e-3
    rail_cap: float = 0.0406

    @property
    def rho(self) -> mpf:
        """How near a nose's line the centre comes, in plan: its nose is h - R above the centre."""
        return mp.sqrt(self.radius**2 - (self.nose_height - self.radius) ** 2)


def real(world: World) -> RealWorld:
    """The world of a ball in the air: only tables with jaws fly."""
    assert isinstance(world, RealWorld)
    return world


def dot(a: mpc, b: mpc) -> mpf:
    return a.real * b.real + a.imag * b.imag


def unit(a: mpc) -> mpc:
    return a / abs(a)


def slip(world: World, ball: Ball) -> mpc:
    """Slip at the cloth, u = v + R k x w."""
    return ball.velocity + world.radius * 1j * ball.w_xy


def energy(world: World, ball: Ball) -> mpf:
    """Kinetic energy per mass: v^2/2 + (2/5 R^2) w^2/2."""
    spin2 = dot(ball.w_xy, ball.w_xy) + ball.w_z**2
    return (dot(ball.velocity, ball.velocity) + ball.rise**2 + mpf(2) / 5 * world.radius**2 * spin2) / 2
