"""The record of a game as JSON lines: a header, a line for every stroke or decision, the end with the secrets, a seal.

The header is written before the break and holds the commitment, never a secret; the line at the end reveals
them. Every line is a JSON object of its own, chained to the one before it, so that lines can be appended as the
game goes on.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from physics.status import Status
from referee.errors import InvalidGame
from referee.game import Game, Outcome
from referee.play import GameSeeds, GrantedBudget, Stroke, client_seeds_from_hex
from referee.play.seeds import ClientSeeds
from referee.record.chain import Chain
from referee.record.commitment import FORMAT, MatchTerms
from referee.record.signing import unsigned_seal


@dataclass(frozen=True, slots=True)
class Header:
    """All that is fixed before the break.

    Attributes:
        terms: those of the match.
        game: id. number: of the game in its match, from 0.
        players: names, by seat.
        allowance_ns: thinking time of each player; None without clocks.
        budget: of simulated shots; None without one.
        client_seeds: what the players added to the draw, after the commitment.
        commitment: to the terms and the secrets (``MatchTerms.commitment``).
        start: the game before its first stroke: the balls racked, or the position that was given.
    """

    terms: MatchTerms
    game: str
    number: int
    players: tuple[str, str]
    allowance_ns: int | None
    budget: GrantedBudget | None
    client_seeds: ClientSeeds
    commitment: str
    start: Game

    def __post_init__(self) -> None:
        number, games = self.number, self.terms.games
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < games:
            raise InvalidGame("number", number, f"must be an integer in [0, {games}), the match having {games} games")

    @classmethod
    def of(
        cls,
        terms: MatchTerms,
        start: Game,
        seeds: GameSeeds,
        *,
        game: str,
        number: int = 0,
        players: tuple[str, str],
        allowance_ns: int | None = None,
        budget: GrantedBudget | None = None,
    ) -> "Header":
        """The header of a game about to be played."""
        return cls(
            terms=terms,
            game=game,
            number=number,
            players=players,
            allowance_ns=allowance_ns,
            budget=budget,
            client_seeds=seeds.client_seeds,
            commitment=terms.commitment(seeds, number),
            start=start,
        )

    def to_dict(self) -> dict[str, Any]:
        """The header line's object."""
        return {
            "type": "game",
            **self.terms.to_dict(),
            "game": self.game,
            "number": self.number,
            "players": list(self.players),
            "allowance_ns": self.allowance_ns,
            "budget": None if self.budget is None else self.budget.to_dict(),
            "client_seeds": [None if seed is None else seed.hex() for seed in self.client_seeds],
            "commitment": self.commitment,
            "start": self.start.to_dict(),
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
            own_first, own_second = values["client_seeds"]
            return cls(
                terms=MatchTerms.from_dict(values),
                game=values["game"],
                number=values["number"],
                players=(first, second),
                allowance_ns=values["allowance_ns"],
                budget=None if values["budget"] is None else GrantedBudget.from_dict(values["budget"]),
                client_seeds=client_seeds_from_hex((own_first, own_second)),
                commitment=values["commitment"],
                start=Game.from_dict(values["start"]),
            )
        except (KeyError, TypeError, AttributeError) as error:
            raise InvalidGame("header", sorted(values), f"a header of format {FORMAT}: {error!r}") from None


def stroke_entry(stroke: Stroke, entry: int, elapsed_ns: int | None = None, *, events: bool = True) -> dict[str, Any]:
    """The object of one stroke or decision.

    Args:
        stroke: what happened, its result with events.
        entry: number of the line among strokes and decisions, from 0.
        elapsed_ns: thinking time charged for it; None without clocks.
        events: whether they are in it, or written apart.
    """
    return {
        "type": "stroke",
        "entry": entry,
        "stroke": stroke.index,
        "seat": stroke.seat,
        "elapsed_ns": elapsed_ns,
        "action": stroke.action.to_dict(),
        **_played(stroke, events),
        "ruling": stroke.ruling.to_dict(whole=False),
        "game": stroke.game.to_dict(),
    }


def end_entry(
    entries: int,
    outcome: Outcome,
    seeds: GameSeeds,
    elapsed_ns: Sequence[int] = (0, 0),
    simulated: Sequence[int] | None = None,
) -> dict[str, Any]:
    """The object of the line that ends the game and reveals its secrets.

    Args:
        entries: how many strokes and decisions there were.
        outcome: the result.
        seeds: of the game, now revealed.
        elapsed_ns: thinking time, by seat, charged after the last stroke: what a time-out rests on.
        simulated: shots counted against the budget, by seat; None without one.
    """
    return {
        "type": "end",
        "entries": entries,
        "outcome": outcome.to_dict(),
        "elapsed_ns": list(elapsed_ns),
        "simulated": None if simulated is None else list(simulated),
        "noise_secret": seeds.noise.hex(),
        "rack_secret": seeds.racks.hex(),
    }


def record_lines(
    header: Header,
    strokes: Iterable[tuple[Stroke, int | None]],
    outcome: Outcome,
    seeds: GameSeeds,
    elapsed_ns: Sequence[int] = (0, 0),
    simulated: Sequence[int] | None = None,
) -> Iterator[str]:
    """The whole record of a finished game, chained and unsigned, line by line, without line ends.

    Args:
        header: of the game.
        strokes: each with the thinking time charged for it.
        outcome, seeds, elapsed_ns, simulated: as for ``end_entry``.
    """
    chain = Chain()
    yield chain.add(header.to_dict())
    entries = 0
    for stroke, elapsed in strokes:
        yield chain.add(stroke_entry(stroke, entries, elapsed))
        entries += 1
    yield chain.add(end_entry(entries, outcome, seeds, elapsed_ns, simulated))
    yield chain.add(unsigned_seal())


def _played(stroke: Stroke, events: bool) -> dict[str, Any]:
    """What the physics did; nothing for a decision."""
    result, shot = stroke.result, stroke.shot
    if result is None or shot is None:
        return {}
    return {
        "before": stroke.before.to_dict(),
        "shot": shot.to_dict(),
        **({"events": result.events.to_dicts()} if events else {}),
        "status": Status(result.status).name.lower(),
        "duration": result.duration,
        "final": result.final.to_dict(),
        **({"miscue": True} if result.facts.miscue else {}),
    }
