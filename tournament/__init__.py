"""Tournaments as pure values: terms, pairings, results, standings, statistics.

No network, no processes, no clock: whoever runs an event asks it what is due and tells it what came of it.
"""

from tournament.choices import Drawn, Format, Seeding, TieBreak
from tournament.entrant import Entrant
from tournament.errors import InvalidResult, InvalidSpec, TournamentError
from tournament.noise_plan import NoisePlan
from tournament.pairings import Bye, Due, Pair, Plan
from tournament.presets import PRESETS, RECOMMENDED
from tournament.results import GameResult
from tournament.seeds import game_seeds
from tournament.spec import Spec
from tournament.sprt_terms import SprtTerms
from tournament.standings import Standing, standings
from tournament.tournament import Tournament, forfeit

__all__ = [
    "PRESETS",
    "RECOMMENDED",
    "Bye",
    "Drawn",
    "Due",
    "Entrant",
    "Format",
    "GameResult",
    "InvalidResult",
    "InvalidSpec",
    "NoisePlan",
    "Pair",
    "Plan",
    "Seeding",
    "Spec",
    "SprtTerms",
    "Standing",
    "TieBreak",
    "Tournament",
    "TournamentError",
    "forfeit",
    "game_seeds",
    "standings",
]
