"""Formats: who meets whom, given the terms and the results so far.

Each format is one function from terms, results and withdrawals to a ``Plan``. It keeps no state: asked again with
more results, it says the same about what was certain before, and more.
"""

from collections.abc import Mapping
from typing import Protocol

from tournament.choices import Format
from tournament.formats.gauntlet import plan_gauntlet
from tournament.formats.knockout import plan_knockout
from tournament.formats.round_robin import plan_round_robin
from tournament.formats.swiss import plan_swiss
from tournament.pairings import Plan
from tournament.results import GameResult
from tournament.scores import Key
from tournament.spec import Spec


class Planner(Protocol):
    """What a format is.

    Args:
        spec: the terms.
        games: the result that counts for each game played.
        withdrawn: name to the first round in which that entrant is not paired any more.
    """

    def __call__(self, spec: Spec, games: Mapping[Key, GameResult], withdrawn: Mapping[str, int]) -> Plan:
        """The pairs that are certain."""


def planner(kind: Format) -> Planner:
    """The function behind a format."""
    planners: dict[Format, Planner] = {
        Format.ROUND_ROBIN: plan_round_robin,
        Format.GAUNTLET: plan_gauntlet,
        Format.SWISS: plan_swiss,
        Format.KNOCKOUT: plan_knockout,
    }
    return planners[kind]


__all__ = ["Planner", "planner"]
