"""Formats by name: the Olympiad's, and the one that tells players apart.

The computational pool tournaments of the Computer Olympiads were round robins of 8-ball with execution noise known to
the players (Archibald, Altman, Greenspan & Shoham, "Computational Pool: A New Challenge for Game Theory Pragmatics", AI
Magazine 31(4), 2010); breaks alternate, which every pair of games here does by itself.
"""

from collections.abc import Mapping
from typing import Any, Final

from tournament.errors import InvalidSpec

_COMMON: Final[Mapping[str, Any]] = {"format": "round_robin", "seconds": 300.0, "table": "olympiad"}

PRESETS: Final[Mapping[str, Mapping[str, Any]]] = {
    "olympiad-noise-1": {**_COMMON, "noise": {"levels": [1.0], "told": True}},
    "olympiad-noise-5": {**_COMMON, "noise": {"levels": [5.0], "told": True}},
    "olympiad-variable-noise": {**_COMMON, "noise": {"range": [0.0, 5.0], "told": True}},
    "nine-foot-noise-2": {**_COMMON, "table": "nine_foot", "noise": {"levels": [2.0], "told": True}},
}
"""Name to the fields of ``Spec`` that it sets."""

RECOMMENDED: Final = "nine-foot-noise-2"
"""The contest in which breaks are run out least, of those whose pairs vary no more than at noise 1 on the Olympiad
table (`benchmarks/contest.py`)."""


def expand(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values with those of their ``"preset"`` under them.

    Raises:
        InvalidSpec: there is no such preset.
    """
    given = dict(values)
    name = given.pop("preset", None)
    if name is None:
        return given
    if not isinstance(name, str) or name not in PRESETS:
        raise InvalidSpec("preset", name, f"must be one of {', '.join(PRESETS)}")
    return {**PRESETS[name], **given}
