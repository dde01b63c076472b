"""Playing: seeds and commitment, noise, the stroke (one loop body for everyone), clocks, budgets.

``referee.play.local`` plays whole games without a server; it is imported by name, because it needs the wire.
"""

from referee.play.budget import Budgets, BudgetSpent, SimulationBudget
from referee.play.clock import Charge, Clocks, LagAllowance, nanoseconds
from referee.play.noise import NoiseModel
from referee.play.seeds import GameSeeds, MatchSeed, commitment, seed_from_hex
from referee.play.stroke import Refused, Stroke, begin_game, play_stroke, start_game

__all__ = [
    "BudgetSpent",
    "Budgets",
    "Charge",
    "Clocks",
    "GameSeeds",
    "LagAllowance",
    "MatchSeed",
    "NoiseModel",
    "Refused",
    "SimulationBudget",
    "Stroke",
    "begin_game",
    "commitment",
    "nanoseconds",
    "play_stroke",
    "seed_from_hex",
    "start_game",
]
