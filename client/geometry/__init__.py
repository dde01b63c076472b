"""Plane geometry every player writes: aiming, ghost balls, straight pots, what is in the way.

Everything here is plane geometry on positions in metres and angles in degrees; nothing is simulated.
"""

from client.geometry.aim import Point, azimuth, cut_angle, distance, ghost_ball
from client.geometry.paths import blockers, is_clear
from client.geometry.placement import is_free, lattice
from client.geometry.pots import Pot, pot, pots

__all__ = [
    "Point",
    "Pot",
    "azimuth",
    "blockers",
    "cut_angle",
    "distance",
    "ghost_ball",
    "is_clear",
    "is_free",
    "lattice",
    "pot",
    "pots",
]
