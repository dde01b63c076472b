"""The terms of an event: who plays, in which format, how many games, under which noise and clock.

A spec is a value: the same spec and the same results give the same pairings, racks and noise.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Any, Self

from pydantic import GetJsonSchemaHandler, PlainValidator, model_validator
from pydantic_core import CoreSchema

from referee.play.clock import LEAST_SECONDS, MOST_SECONDS
from tournament.choices import DEFAULT_TIE_BREAKS, Drawn, Format, Seeding, TieBreak
from tournament.entrant import Entrant
from tournament.errors import InvalidSpec
from tournament.noise_plan import NoisePlan
from tournament.presets import PRESETS, expand
from tournament.spec_fields import lots_of, seed_of, table_of
from tournament.sprt_terms import SprtTerms
from tournament.validation import Name, Value, integer, items, number, one_of, value

MOST_ENTRANTS, MOST_PAIRS, MOST_ROUNDS = 1000, 100_000, 1000
MOST_IN_SWISS = 256
"""Entrants of a Swiss: pairing a round of so many takes one to three seconds."""
MOST_IN_EVENT = 250_000
"""Pairs of games in an event: they are planned in memory."""
MOST_SHOTS = 10**9
"""Bounds that keep a slip of the pen from asking for a million years of play."""


@value(InvalidSpec, "event", is_part=False)
class Spec(Value):
    """The terms of an event.

    ``from_dict`` reads a JSON object or a TOML table: what is left out has its default, and ``"preset"`` names one of
    ``PRESETS``, whose values what is given here overrides. Unknown keys are refused; ``"foreseeable"``, which published
    terms have, follows from the others.

    Attributes:
        name: of the event.
        entrants: 2 to 1000 with different names, at most 256 in a Swiss.
        format: who meets whom.
        pairs: pairs of games in a meeting. The two games of a pair have the same racks and levels, the break
            swapped, and noise of their own.
        rounds: of a Swiss, at least 1; None in any other format.
        challengers: of a gauntlet, how many entrants from the top of the list challenge the others.
        extra_pairs: of a knockout, pairs added one by one while a meeting is drawn.
        drawn: of a knockout, who goes on after that.
        seeding: whether the order of the entrants counts or is drawn.
        tie_breaks: in this order; empty: those of the format.
        noise: the levels and whether the players are told.
        seconds: thinking time a player has for a game, 0.001 to 86,400; None: no wall clock.
        simulated_shots: shots a player may simulate in a game; None: any number.
        table: a name of ``physics.table.NAMED``, or a table's name and parameters as ``physics.Table.to_dict`` gives
            them; those left out have the named table's value.
        seed: lots, levels, racks and noise come from it. Left out (None), a server draws 256 bits; without a server the
            event repeats. Chosen, for a test that is to repeat: an integer, or 64 hexadecimal digits.
        sprt: stop as soon as this test decides; for two entrants.
        lots: 64 hexadecimal digits that a server has drawn beside the seed: order, lots and levels come from them, and
            tell nothing of racks and noise. None wherever the seed was chosen.

    Raises:
        InvalidSpec: naming the field, its value and what is allowed.
    """

    name: Name
    entrants: Annotated[tuple[Entrant, ...], items(2, MOST_ENTRANTS)]
    format: Annotated[Format, one_of(Format)] = Format.ROUND_ROBIN
    pairs: Annotated[int, integer(1, MOST_PAIRS)] = 1
    rounds: Annotated[int, integer(1, MOST_ROUNDS)] | None = None
    challengers: Annotated[int, integer(1, MOST_ENTRANTS)] = 1
    extra_pairs: Annotated[int, integer(0, MOST_PAIRS)] = 2
    drawn: Annotated[Drawn, one_of(Drawn)] = Drawn.SEED
    seeding: Annotated[Seeding, one_of(Seeding)] = Seeding.LISTED
    tie_breaks: Annotated[tuple[Annotated[TieBreak, one_of(TieBreak)], ...], items(0, len(TieBreak))] = ()
    noise: NoisePlan = NoisePlan()
    seconds: Annotated[float, number(LEAST_SECONDS, MOST_SECONDS)] | None = 300.0
    simulated_shots: Annotated[int, integer(0, MOST_SHOTS)] | None = None
    table: Annotated[str | Mapping[str, Any], PlainValidator(table_of)] = "olympiad"
    seed: Annotated[int | str | None, PlainValidator(seed_of)] = None
    sprt: SprtTerms | None = None
    lots: Annotated[str | None, PlainValidator(lots_of)] = None

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """With what ``from_dict`` takes beside the fields."""
        found = handler(schema)
        properties = handler.resolve_ref_schema(found)["properties"]
        properties |= {"preset": {"enum": sorted(PRESETS)}, "foreseeable": {"type": "boolean"}}
        return found

    @model_validator(mode="before")
    @classmethod
    def _expanded(cls, data: Any) -> Any:
        """With the preset's values, and without the mark of published terms."""
        if not isinstance(data, Mapping):
            return data
        values = expand(data)
        marked = values.pop("foreseeable", None)
        if marked is not None and not isinstance(marked, bool):
            raise InvalidSpec("foreseeable", marked, "must be true or false")
        if marked is False and values.get("seed") is not None and values.get("lots") is None:
            raise InvalidSpec("foreseeable", marked, "must be true where a seed is chosen")
        return values

    def __post_init__(self) -> None:
        object.__setattr__(self, "tie_breaks", self.tie_breaks or DEFAULT_TIE_BREAKS[self.format])
        _check_together(self)

    @property
    def names(self) -> tuple[str, ...]:
        """The entrants' names, as listed."""
        return tuple(entrant.name for entrant in self.entrants)

    @property
    def foreseeable(self) -> bool:
        """Whether somebody can know racks and noise in advance: no server has drawn them."""
        return self.lots is None

    def to_dict(self) -> dict[str, Any]:
        """JSON form, seed and lots included: as long as the event goes on, this is for whoever runs it alone."""
        terms = Value.to_dict(self)
        return terms if self.lots is not None else {name: terms[name] for name in terms if name != "lots"}

    def published(self) -> dict[str, Any]:
        """The terms as everybody may read them while the event goes on.

        Without seed and lots, without levels of noise that the players are not told, and without what the players run;
        with ``foreseeable``.
        """
        terms = {name: value for name, value in self.to_dict().items() if name not in ("seed", "lots")}
        entrants = [{"name": name} for name in self.names]
        return terms | {"noise": self.noise.published(), "entrants": entrants, "foreseeable": self.foreseeable}

    def revealed(self) -> dict[str, Any]:
        """The same when the event is over: nothing but what the players run is kept back."""
        lots = {} if self.lots is None else {"lots": self.lots}
        return self.published() | {"noise": self.noise.to_dict(), "seed": self.seed} | lots

    def with_seed(self, seed: int | str) -> Self:
        """The same terms with a seed that is chosen."""
        return replace(self, seed=seed, lots=None)


def _check_together(spec: Spec) -> None:
    """What one field allows another.

    Raises:
        InvalidSpec: they contradict each other.
    """
    swiss, count = spec.format is Format.SWISS, len(spec.entrants)
    if twice := [name for name, times in Counter(spec.names).items() if times > 1]:
        raise InvalidSpec("entrants", twice[0], "must be names that are all different")
    if swiss and spec.rounds is None:
        raise InvalidSpec("rounds", spec.rounds, "must be given: a Swiss has as many rounds as its terms say")
    if swiss and count > MOST_IN_SWISS:
        raise InvalidSpec("entrants", f"{count} entrants", f"must be at most {MOST_IN_SWISS} in a Swiss")
    if not swiss and spec.rounds is not None:
        raise InvalidSpec("rounds", spec.rounds, f"must be left out: a {spec.format} has the rounds it needs")
    if spec.format is Format.GAUNTLET and spec.challengers >= count:
        raise InvalidSpec("challengers", spec.challengers, f"must be fewer than the {count} entrants")
    most = _most_meetings(spec) * (spec.pairs + (spec.extra_pairs if spec.format is Format.KNOCKOUT else 0))
    if most > MOST_IN_EVENT:
        allowed = (
            f"must be such that there are at most {MOST_IN_EVENT} pairs of games in an event; these terms make {most}"
        )
        raise InvalidSpec("pairs", spec.pairs, allowed)
    if spec.lots is not None and isinstance(spec.seed, int):
        raise InvalidSpec("lots", "<64 letters>", "must be left out where a seed is chosen")
    if spec.sprt is not None and (count != 2 or spec.format is Format.KNOCKOUT):
        raise InvalidSpec(
            "sprt", f"{count} entrants, {spec.format}", "must be left out but for two entrants, and no knockout"
        )


def _most_meetings(spec: Spec) -> int:
    """Meetings of the whole event."""
    n = len(spec.entrants)
    return {
        Format.ROUND_ROBIN: n * (n - 1) // 2,
        Format.GAUNTLET: spec.challengers * (n - spec.challengers),
        Format.SWISS: (spec.rounds or 0) * (n // 2),
        Format.KNOCKOUT: n - 1,
    }[spec.format]
