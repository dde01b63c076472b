"""The commitment: one digest, published before the players add their seeds, that fixes a match.

It covers the anchors of both chains of secrets (``referee.play.seeds``) together with the engine, the rules, the
table and the noise, so that none of them can be exchanged afterwards. The anchors themselves stay secret until
the first game is over: without them nobody can try out which noise level was committed to.
"""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Self

from physics.table import Table
from referee.errors import InvalidGame
from referee.game import Game
from referee.play import LINKS, GameSeeds, MatchSeed, NoiseModel, start_game
from referee.play.seeds import anchor, rack_link
from referee.record.canonical import canonical
from referee.record.engine import Engine, this_engine
from referee.rules import EightBall, Limits, breaker

FORMAT: Final = "pooliad/1"


@dataclass(frozen=True, slots=True)
class MatchTerms:
    """What is committed to before a match.

    Attributes:
        match: its id.
        games: how many, at most 1000.
        rules: the referee with table and limits.
        noise: its level, whether the players are told, and standard deviations other than the Olympiad's.
        shared_racks: the racks follow from a secret that other matches may share.
        paired_racks: games 0 and 1, 2 and 3, … have the same racks.
        first_breaker: the seat that was told to break first; None: it is drawn.
        position: where every game begins instead of a break, the seats exchanged in every second one.
        engine: what the match is played with.
    """

    match: str
    games: int
    rules: EightBall
    noise: NoiseModel
    shared_racks: bool = False
    paired_racks: bool = False
    first_breaker: int | None = None
    position: Game | None = None
    engine: Engine = field(default_factory=this_engine)

    def __post_init__(self) -> None:
        _require_integer("games", self.games, 1, LINKS)
        if self.first_breaker is not None:
            _require_integer("first_breaker", self.first_breaker, 0, 1)
        for name, flag in (("racks.shared", self.shared_racks), ("racks.paired", self.paired_racks)):
            if not isinstance(flag, bool):
                raise InvalidGame(name, flag, "must be true or false")

    def commitment(self, seeds: GameSeeds, number: int) -> str:
        """The commitment that the secrets of the ``number``-th game belong to: SHA-256, hex.

        Every game of a match leads to the same one.
        """
        anchors = {
            "noise_anchor": anchor(seeds.noise, number).hex(),
            "rack_anchor": anchor(seeds.racks, rack_link(number, self.paired_racks)).hex(),
        }
        return hashlib.sha256(canonical(self.to_dict() | anchors).encode()).hexdigest()

    def commitment_to(self, seed: MatchSeed) -> str:
        """The commitment of a match that is to be played from this seed."""
        return self.commitment(seed.game(0), 0)

    def start(self, seeds: GameSeeds, number: int) -> Game:
        """The ``number``-th game before its first stroke.

        Raises:
            InvalidGame: the position cannot be played on from.
        """
        if self.position is None:
            return start_game(self.rules, seeds, self.breaker(seeds, number))
        position = self.rules.begin_from(self.position)
        return position.exchanged() if number % 2 else position

    def breaker(self, seeds: GameSeeds, number: int) -> int:
        """The seat that breaks the ``number``-th game, or would: the break alternates (R50)."""
        first = seeds.first_breaker(number) if self.first_breaker is None else self.first_breaker
        return breaker(first, number)

    def to_dict(self) -> dict[str, Any]:
        """What is digested together with the anchors, and part of every record's header."""
        return {
            "format": FORMAT,
            "engine": self.engine.to_dict(),
            "match": self.match,
            "games": self.games,
            "rules": {"name": "eight_ball", "limits": self.rules.limits.to_dict()},
            "table": self.rules.table.to_dict(),
            "noise": self.noise.to_dict(),
            "racks": {"shared": self.shared_racks, "paired": self.paired_racks},
            "first_breaker": self.first_breaker,
            "position": None if self.position is None else self.position.to_dict(),
        }

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read what ``to_dict`` wrote; further keys are left alone.

        Raises:
            InvalidGame, physics.PhysicsError, ValueError, KeyError, TypeError: something is missing or cannot be.
        """
        return cls(
            match=values["match"],
            games=values["games"],
            rules=EightBall(Table.from_dict(values["table"]), Limits.from_dict(values["rules"]["limits"])),
            noise=NoiseModel.from_dict(values["noise"]),
            shared_racks=values["racks"]["shared"],
            paired_racks=values["racks"]["paired"],
            first_breaker=values["first_breaker"],
            position=None if values["position"] is None else Game.from_dict(values["position"]),
            engine=Engine.from_dict(values["engine"]),
        )


def _require_integer(name: str, value: Any, least: int, greatest: int) -> None:
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= greatest:
        raise InvalidGame(name, value, f"must be an integer in [{least}, {greatest}]")
