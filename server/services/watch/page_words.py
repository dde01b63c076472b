"""What the page says of a table, of noise, of a game's end, said by the server: as `tables.js` and `words.js` have it.

A test compares all of it.
"""

import json
from typing import Any, Final

from physics import Table

TITLES: Final = {
    "olympiad": "Olympiad",
    "fastfiz": "FastFiz",
    "nine_foot": "nine-foot",
    "eight_foot": "eight-foot",
    "seven_foot": "seven-foot",
}
REASONS: Final = {
    "eight_made": "the 8 made as called",
    "eight_with_foul": "the 8 pocketed with a foul",
    "eight_too_early": "the 8 pocketed too early",
    "eight_not_as_called": "the 8 pocketed other than called",
    "eight_off_table": "the 8 left the table",
}


def ending_in_words(outcome: dict[str, Any], players: list[str]) -> str:
    """How a game ended, as `describeOutcome` of the page says it."""
    reason = outcome["reason"]
    why = REASONS.get(reason) or reason.replace("_", " ")
    return f"Drawn: {why}" if outcome["winner"] is None else f"{players[outcome['winner']]} wins: {why}"


def table_in_words(table: dict[str, Any]) -> str:
    """A table's name, and what is otherwise than there, as `describeTable` of the page says it."""
    usual = Table.named(table["name"]).to_dict()
    own = [key.replace("_", " ") for key in table if table[key] != usual[key]]
    return f"{TITLES[table['name']]} table" + (f", own {', '.join(own)}" if own else "")


def noise_in_words(level: float | None) -> str:
    """How much noise there is, as `describeNoise` of the page says it."""
    if level is None:
        return "noise not told"
    return f"noise {json.dumps(level).removesuffix('.0')}" if level else "no noise"
