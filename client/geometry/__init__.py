"""Plane geometry every player writes: aiming, ghost balls, pots, banks, what is in the way.

Everything here is plane geometry on positions in metres and angles in degrees; nothing is simulated.
"""

from client.geometry.aim import Point, azimuth, cut_angle, distance, ghost_ball
from client.geometry.banks import Bank, bank, banks, kick
from client.geometry.paths import blockers, is_clear
from client.geometry.placement import are_free, is_free, lattice
from client.geometry.pots import Pot, pot, pots

__all__ = [
    "Bank",
    "Point",
    "Pot",
    "are_free",
    "azimuth",
    "bank",
    "banks",
    "blockers",
    "cut_angle",
    "distance",
    "ghost_ball",
    "is_clear",
    "is_free",
    "kick",
    "lattice",
    "pot",
    "pots",
]
