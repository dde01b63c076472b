"""Plane geometry every player writes: aiming, ghost balls, pots, banks, what is in the way.

Positions are in metres, angles in degrees. Nothing is simulated, except once for each table with jaws: what its pockets
let in (`client.geometry.entering`).
"""

from client.geometry.aim import Point, azimuth, cut_angle, distance, ghost_ball
from client.geometry.banks import Bank, bank, banks, kick
from client.geometry.openings import Opening, opening
from client.geometry.paths import blockers, is_clear
from client.geometry.placement import are_free, is_free, lattice
from client.geometry.pots import Pot, pot, pots
from client.geometry.strokes import aimed

__all__ = [
    "Bank",
    "Opening",
    "Point",
    "Pot",
    "aimed",
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
    "opening",
    "pot",
    "pots",
]
