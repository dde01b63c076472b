"""The record of a game as JSON lines: a header, a line for every stroke or decision, the end with the seeds.

The header is written before the break and holds the commitment, never a seed; the last line reveals the
seeds. Every line is a JSON object of its own with ``type`` first to look at, so that lines can be appended as
the game goes on.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final

from physics.status import Status
from physics.table import Table
from referee.errors import InvalidGame
from referee.game import Game, Outcome
from referee.play import GameSeeds, NoiseModel, Stroke
from referee.record.canonical import canonical
from referee.record.engine import Engine, this_engine
from referee.rules import EightBall, Limits

FORMAT: Final = "pooliad/1"


@dataclass(frozen=True, slots=True)
class Header:
    """All that is fixed before the break.

    Attributes:
        game, match: ids. number: of the game in its match, from 0.
        players: names, by seat.
        rules: the referee with table and limits.
        noise: its level and whether the players were told.
        allowance_ns: thinking time of each player; None without clocks.
        commitment: SHA-256 of the noise seed.
        start: the game before its first stroke: the balls racked, or the position that was given.
        given: whether that position was given by whoever made the match, instead of a break.
        engine: what the game is played with.
    """

    game: str
    match: str
    number: int
    players: tuple[str, str]
    rules: EightBall
    noise: NoiseModel
    allowance_ns: int | None
    commitment: str
    start: Game
    given: bool
    engine: Engine

    @classmethod
    def of(
        cls,
        rules: EightBall,
        start: Game,
        seeds: GameSeeds,
        noise: NoiseModel,
        *,
        game: str,
        match: str,
        number: int = 0,
        players: tuple[str, str],
        allowance_ns: int | None = None,
        given: bool = False,
    ) -> "Header":
        """The header of a game about to be played with the running engine."""
        return cls(
            game=game,
            match=match,
            number=number,
            players=players,
            rules=rules,
            noise=noise,
            allowance_ns=allowance_ns,
            commitment=seeds.commitment,
            start=start,
            given=given,
            engine=this_engine(),
        )

    def to_dict(self) -> dict[str, Any]:
        """The header line's object."""
        return {
            "type": "game",
            "format": FORMAT,
            "engine": self.engine.to_dict(),
            "game": self.game,
            "match": self.match,
            "number": self.number,
            "players": list(self.players),
            "rules": {"name": "eight_ball", "limits": asdict(self.rules.limits)},
            "table": self.rules.table.to_dict(),
            "noise": {"level": self.noise.level, "told": self.noise.told},
            "allowance_ns": self.allowance_ns,
            "commitment": self.commitment,
            "start": self.start.to_dict(),
            "given": self.given,
        }

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> "Header":
        """Read what ``to_dict`` wrote.

        Raises:
            InvalidGame, physics.PhysicsError, ValueError: something is missing or cannot be.
        """
        if values.get("format") != FORMAT:
            raise InvalidGame("format", values.get("format"), f"must be {FORMAT!r}")
        try:
            first, second = values["players"]
            return cls(
                game=values["game"],
                match=values["match"],
                number=values["number"],
                players=(first, second),
                rules=EightBall(Table.from_dict(values["table"]), Limits(**values["rules"]["limits"])),
                noise=NoiseModel(**values["noise"]),
                allowance_ns=values["allowance_ns"],
                commitment=values["commitment"],
                start=Game.from_dict(values["start"]),
                given=_flag("given", values["given"]),
                engine=Engine.from_dict(values["engine"]),
            )
        except (KeyError, TypeError, AttributeError) as error:
            raise InvalidGame("header", sorted(values), f"a header of format {FORMAT}: {error!r}") from None


def stroke_entry(stroke: Stroke, entry: int, elapsed_ns: int | None = None) -> dict[str, Any]:
    """The object of one stroke or decision.

    Args:
        stroke: what happened, its result with events.
        entry: number of the line among strokes and decisions, from 0.
        elapsed_ns: thinking time charged for it; None without clocks.
    """
    return {
        "type": "stroke",
        "entry": entry,
        "stroke": stroke.index,
        "seat": stroke.seat,
        "elapsed_ns": elapsed_ns,
        "action": stroke.action.to_dict(),
        **_played(stroke),
        "ruling": {key: value for key, value in stroke.ruling.to_dict().items() if key not in ("game", "allowed")},
        "game": stroke.game.to_dict(),
    }


def end_entry(entries: int, outcome: Outcome, seeds: GameSeeds, elapsed_ns: Sequence[int] = (0, 0)) -> dict[str, Any]:
    """The object of the last line.

    Args:
        entries: how many strokes and decisions there were.
        outcome: the result.
        seeds: of the game, now revealed.
        elapsed_ns: thinking time, by seat, charged after the last stroke: what a time-out rests on.
    """
    return {
        "type": "end",
        "entries": entries,
        "outcome": outcome.to_dict(),
        "elapsed_ns": list(elapsed_ns),
        "noise_seed": seeds.noise.hex(),
        "rack_seed": seeds.racks.hex(),
    }


def record_lines(
    header: Header,
    strokes: Iterable[tuple[Stroke, int | None]],
    outcome: Outcome,
    seeds: GameSeeds,
    elapsed_ns: Sequence[int] = (0, 0),
) -> Iterator[str]:
    """The whole record of a finished game, line by line, without line ends.

    Args:
        header: of the game.
        strokes: each with the thinking time charged for it.
        outcome, seeds, elapsed_ns: as for ``end_entry``.
    """
    yield canonical(header.to_dict())
    entries = 0
    for stroke, elapsed in strokes:
        yield canonical(stroke_entry(stroke, entries, elapsed))
        entries += 1
    yield canonical(end_entry(entries, outcome, seeds, elapsed_ns))


def _played(stroke: Stroke) -> dict[str, Any]:
    """What the physics did; nothing for a decision."""
    result, shot = stroke.result, stroke.shot
    if result is None or shot is None:
        return {}
    return {
        "before": stroke.before.to_dict(),
        "shot": shot.to_dict(),
        "events": [event.to_dict() for event in result.events],
        "status": Status(result.status).name.lower(),
        "duration": result.duration,
        "final": result.final.to_dict(),
    }


def _flag(field: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise InvalidGame(field, value, "true or false")
    return value
