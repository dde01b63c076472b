"""Playing: seeds and commitment, noise, the stroke (one loop body for everyone), clocks, budgets.

``client.local_game`` plays whole games without a server; it is imported by name, because it needs the wire.
"""

from referee.play.budget import Budgets, BudgetSpent, GrantedBudget, SimulationBudget
from referee.play.clock import Charge, Clocks, LagAllowance, nanoseconds
from referee.play.noise import NoiseModel
from referee.play.seeds import LINKS, GameSeeds, MatchSeed, client_seeds_from_hex, seed_from_hex
from referee.play.stroke import Refused, Stroke, play_stroke, start_game

__all__ = [
    "LINKS",
    "BudgetSpent",
    "Budgets",
    "Charge",
    "Clocks",
    "GameSeeds",
    "GrantedBudget",
    "LagAllowance",
    "MatchSeed",
    "NoiseModel",
    "Refused",
    "SimulationBudget",
    "Stroke",
    "client_seeds_from_hex",
    "nanoseconds",
    "play_stroke",
    "seed_from_hex",
    "start_game",
]
