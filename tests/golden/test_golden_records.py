"""The records of whole games, line for line, as commit 687740a wrote them, before views and rulings became lazy.

That of the nine-foot table is younger: since then a cue ball in hand may be placed as near to a nose as it comes there,
strokes of tables with jaws tell of a miscue, and balls leave the cloth.

Each line is pinned by the SHA-256 of what the reference implementation of RFC 8785 makes of its object, the chain and
what names the engine left out: ``python tests/golden/test_golden_records.py`` writes the file anew.
"""

import hashlib
import json
from pathlib import Path

import pytest
import rfc8785

from client import play
from physics import Table, TableState
from referee import Game, Phase

PINNED = Path(__file__).with_name("records.txt")
MIDDLE = Game(
    TableState.from_positions(
        {0: (0.5, 1.7), 3: (0.4, 0.6), 8: (0.9, 0.4), 11: (0.2, 1.1), 5: (1.05, 0.07), 14: (0.6, 1.0)}
    ),
    phase=Phase.PLAY,
    turn=0,
    breaker=0,
)
MATCHES = {
    "random": lambda: play("random", "random", games=3, seed=11),
    "quiet": lambda: play("random", "random", games=1, seed=12, noise=0.0, simulations=5),
    "nine foot": lambda: play("random", "random", games=1, seed=13, table=Table.nine_foot()),
    "greedy": lambda: play("greedy", "random", games=2, seed=14, start=MIDDLE),
    "greedy break": lambda: play("greedy", "greedy", games=1, seed=15, simulations=3000),
}


def digests(match):
    """Of every line of every game of a match."""
    for game in match.games:
        for line in game.record():
            values = {key: value for key, value in json.loads(line).items() if key not in ("previous", "engine")}
            values.pop("commitment", None)
            yield hashlib.sha256(rfc8785.dumps(values)).hexdigest()[:16]


def pinned():
    return dict(line.split("\t") for line in PINNED.read_text(encoding="utf-8").splitlines())


@pytest.mark.parametrize("name", MATCHES)
def test_records_are_line_for_line_those_of_before(name):
    assert list(digests(MATCHES[name]())) == pinned()[name].split()


if __name__ == "__main__":
    PINNED.write_text("".join(f"{name}\t{' '.join(digests(play_it()))}\n" for name, play_it in MATCHES.items()))
