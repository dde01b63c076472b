"""The terms of an event: who plays, in which format, how many games, under which noise and clock.

A spec is a value: the same spec and the same results give the same pairings, racks and noise.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from enum import StrEnum
from typing import Any, Self

from referee.play.clock import LEAST_SECONDS, MOST_SECONDS
from tournament.checks import Checker
from tournament.errors import InvalidSpec
from tournament.noise_plan import NoisePlan
from tournament.presets import expand
from tournament.sprt_terms import SprtTerms

MOST_ENTRANTS, MOST_PAIRS, MOST_ROUNDS = 1000, 100_000, 1000
MOST_IN_SWISS = 256
"""Entrants of a Swiss: pairing a round of so many takes one to three seconds."""
MOST_IN_EVENT = 250_000
"""Pairs of games in an event: they are planned in memory."""
MOST_SHOTS = 10**9
LONGEST_AGENT = 4096
"""Bounds that keep a slip of the pen from asking for a million years of play."""

_check = Checker(InvalidSpec)


class Format(StrEnum):
    """Who meets whom."""

    ROUND_ROBIN = "round_robin"
    """Everybody meets everybody once."""
    GAUNTLET = "gauntlet"
    """The challengers, the first entrants of the list, meet all others."""
    SWISS = "swiss"
    """A fixed number of rounds; who stands equal meets, nobody twice while that can be avoided."""
    KNOCKOUT = "knockout"
    """Who loses a meeting is out."""


class TieBreak(StrEnum):
    """What separates entrants with equal points, in the order of ``Spec.tie_breaks``."""

    DIRECT = "direct"
    """Points in the games of the tied among themselves."""
    SONNEBORN_BERGER = "sonneborn_berger"
    """Points of the opponents, each weighted by the share taken from them."""
    BUCHHOLZ = "buchholz"
    """Points of the opponents."""
    WINS = "wins"
    """Games won."""
    SEED = "seed"
    """The place in the list of entrants."""


class Drawn(StrEnum):
    """Who goes on when a meeting of a knockout is still drawn after the extra pairs."""

    SEED = "seed"
    """The one seeded higher."""
    LOT = "lot"
    """Drawn by lot, from the event's seed."""


class Seeding(StrEnum):
    """Where the order of the entrants comes from."""

    LISTED = "listed"
    """As listed: the strongest first."""
    DRAWN = "drawn"
    """Drawn by lot, from the event's seed."""


@dataclass(frozen=True, slots=True)
class Entrant:
    """Who takes part.

    Attributes:
        name: unique in the event.
        agent: what plays under that name, for whoever runs the event: a shipped agent's name, an import path, a
            command. Left empty, it is the name.
    """

    name: str
    agent: str = ""

    def __post_init__(self) -> None:
        _check.name("entrant.name", self.name)
        object.__setattr__(self, "agent", _check.text("entrant.agent", self.agent, LONGEST_AGENT) or self.name)

    def to_dict(self) -> dict[str, Any]:
        """``{"name": "greedy", "agent": "greedy"}``."""
        return {"name": self.name, "agent": self.agent}

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read what ``to_dict`` wrote; a text alone is name and agent in one."""
        if isinstance(data, str):
            return cls(data)
        return cls(**_check.object("entrant", data, ("name", "agent"), ("name",)))


_DEFAULT_TIE_BREAKS = {
    Format.ROUND_ROBIN: (TieBreak.DIRECT, TieBreak.SONNEBORN_BERGER, TieBreak.WINS),
    Format.GAUNTLET: (TieBreak.DIRECT, TieBreak.WINS),
    Format.SWISS: (TieBreak.BUCHHOLZ, TieBreak.SONNEBORN_BERGER, TieBreak.WINS),
    Format.KNOCKOUT: (),
}


@dataclass(frozen=True, slots=True)
class Spec:
    """The terms of an event.

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
        table: ``"olympiad"``, ``"fastfiz"`` or a table's parameters as ``physics.Table.to_dict`` gives them.
        seed: lots, levels, racks and noise come from it. Left out (None), a server draws 256 bits; without a server the
            event repeats. Chosen, for a test that is to repeat: an integer, or 64 hexadecimal digits.
        sprt: stop as soon as this test decides; for two entrants.
        lots: 64 hexadecimal digits that a server has drawn beside the seed: order, lots and levels come from them, and
            tell nothing of racks and noise. None wherever the seed was chosen.

    Raises:
        InvalidSpec: naming the field, its value and what is allowed.
    """

    name: str
    entrants: tuple[Entrant, ...]
    format: Format = Format.ROUND_ROBIN
    pairs: int = 1
    rounds: int | None = None
    challengers: int = 1
    extra_pairs: int = 2
    drawn: Drawn = Drawn.SEED
    seeding: Seeding = Seeding.LISTED
    tie_breaks: tuple[TieBreak, ...] = ()
    noise: NoisePlan = field(default_factory=NoisePlan)
    seconds: float | None = 300.0
    simulated_shots: int | None = None
    table: str | Mapping[str, Any] = "olympiad"
    seed: int | str | None = None
    sprt: SprtTerms | None = None
    lots: str | None = None

    def __post_init__(self) -> None:
        for name, value in _checked(self).items():
            object.__setattr__(self, name, value)
        _check_names(self.entrants)
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
        lots = {} if self.lots is None else {"lots": self.lots}
        return lots | {
            "name": self.name,
            "entrants": [entrant.to_dict() for entrant in self.entrants],
            "format": self.format.value,
            "pairs": self.pairs,
            "rounds": self.rounds,
            "challengers": self.challengers,
            "extra_pairs": self.extra_pairs,
            "drawn": self.drawn.value,
            "seeding": self.seeding.value,
            "tie_breaks": [one.value for one in self.tie_breaks],
            "noise": self.noise.to_dict(),
            "seconds": self.seconds,
            "simulated_shots": self.simulated_shots,
            "table": self.table if isinstance(self.table, str) else dict(self.table),
            "seed": self.seed,
            "sprt": None if self.sprt is None else self.sprt.to_dict(),
        }

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

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read a JSON object or a TOML table.

        What is left out has its default; ``"preset"`` names one of ``PRESETS``, whose values what is given here
        overrides. Unknown keys are refused; ``"foreseeable"``, which published terms have, follows from the others.

        Raises:
            InvalidSpec: naming the field, its value and what is allowed.
        """
        known = [one.name for one in fields(cls)]
        values = expand(_check.object("event", data, (*known, "preset", "foreseeable"), ("name", "entrants")))
        _check_foreseeable(values)
        entrants = _check.items("entrants", values["entrants"], 2, MOST_ENTRANTS)
        values["entrants"] = tuple(Entrant.from_dict(one) for one in entrants)
        if "noise" in values:
            values["noise"] = NoisePlan.from_dict(values["noise"])
        if values.get("sprt") is not None:
            values["sprt"] = SprtTerms.from_dict(values["sprt"])
        return cls(**values)

    def with_seed(self, seed: int | str) -> Self:
        """The same terms with a seed that is chosen."""
        return replace(self, seed=seed, lots=None)


def _checked(spec: Spec) -> dict[str, Any]:
    """Every field, checked by itself and in its own type."""
    kind = _check.member(Format, "format", spec.format)
    tie_breaks = _check.items("tie_breaks", spec.tie_breaks, 0, len(TieBreak))
    return {
        "name": _check.name("name", spec.name),
        "entrants": _entrants(spec.entrants),
        "format": kind,
        "pairs": _check.integer("pairs", spec.pairs, 1, MOST_PAIRS),
        "rounds": None if spec.rounds is None else _check.integer("rounds", spec.rounds, 1, MOST_ROUNDS),
        "challengers": _check.integer("challengers", spec.challengers, 1, MOST_ENTRANTS),
        "extra_pairs": _check.integer("extra_pairs", spec.extra_pairs, 0, MOST_PAIRS),
        "drawn": _check.member(Drawn, "drawn", spec.drawn),
        "seeding": _check.member(Seeding, "seeding", spec.seeding),
        "tie_breaks": tuple(_check.member(TieBreak, "tie_breaks", one) for one in tie_breaks)
        or _DEFAULT_TIE_BREAKS[kind],
        "noise": _kind("noise", spec.noise, NoisePlan),
        "seconds": None
        if spec.seconds is None
        else _check.number("seconds", spec.seconds, LEAST_SECONDS, MOST_SECONDS),
        "simulated_shots": None
        if spec.simulated_shots is None
        else _check.integer("simulated_shots", spec.simulated_shots, 0, MOST_SHOTS),
        "table": _table(spec.table),
        "seed": _seed(spec.seed),
        "lots": None if spec.lots is None else _digits("lots", spec.lots),
        "sprt": None if spec.sprt is None else _kind("sprt", spec.sprt, SprtTerms),
    }


def _entrants(value: Any) -> tuple[Entrant, ...]:
    entrants = _check.items("entrants", value, 2, MOST_ENTRANTS)
    return tuple(_kind(f"entrants[{index}]", one, Entrant) for index, one in enumerate(entrants))


def _kind(field: str, value: Any, kind: type) -> Any:
    if not isinstance(value, kind):
        _check.fail(field, value, f"a tournament.{kind.__name__}")
    return value


def _table(value: Any) -> str | Mapping[str, Any]:
    """A table's name or its parameters; the physics says whether they make a table."""
    from physics import InvalidTable, Table

    if value in ("olympiad", "fastfiz"):
        return str(value)
    if not isinstance(value, Mapping):
        _check.fail("table", value, "olympiad, fastfiz or a table's parameters")
    try:
        return Table.from_dict(value).to_dict()
    except InvalidTable as error:
        _check.fail(f"table.{error.field}", error.value, error.allowed)


def _seed(value: Any) -> int | str | None:
    if value is None:
        return None
    return _digits("seed", value) if isinstance(value, str) else _check.integer("seed", value, 0, 2**63 - 1)


def _digits(field: str, value: Any) -> str:
    """A secret in writing; the error does not repeat it."""
    if not isinstance(value, str):
        _check.fail(field, type(value).__name__, "64 lower-case hexadecimal digits")
    if len(value) != 64 or not set(value) <= set("0123456789abcdef"):
        also = ", or an integer" if field == "seed" else ""
        _check.fail(field, f"<{len(value)} letters>", f"64 lower-case hexadecimal digits{also}")
    return value


def _check_foreseeable(values: dict[str, Any]) -> None:
    """Take the mark off published terms; a seed that was chosen is never one that nobody can foresee."""
    given = values.pop("foreseeable", None)
    if given is False and values.get("seed") is not None and values.get("lots") is None:
        _check.fail("foreseeable", given, "true where a seed is chosen")
    if given is not None:
        _check.flag("foreseeable", given)


def _check_names(entrants: tuple[Entrant, ...]) -> None:
    seen: set[str] = set()
    for entrant in entrants:
        if entrant.name in seen:
            _check.fail("entrants", entrant.name, "names that are all different")
        seen.add(entrant.name)


def _check_together(spec: Spec) -> None:
    """What one field allows another."""
    swiss = spec.format is Format.SWISS
    if swiss and spec.rounds is None:
        _check.fail("rounds", spec.rounds, "how many rounds a Swiss has")
    if swiss and len(spec.entrants) > MOST_IN_SWISS:
        _check.fail("entrants", f"{len(spec.entrants)} entrants", f"at most {MOST_IN_SWISS} in a Swiss")
    if not swiss and spec.rounds is not None:
        _check.fail("rounds", spec.rounds, f"nothing: a {spec.format} has the rounds it needs")
    if spec.format is Format.GAUNTLET and spec.challengers >= len(spec.entrants):
        _check.fail("challengers", spec.challengers, f"fewer than the {len(spec.entrants)} entrants")
    most = _most_meetings(spec) * (spec.pairs + (spec.extra_pairs if spec.format is Format.KNOCKOUT else 0))
    if most > MOST_IN_EVENT:
        _check.fail("pairs", spec.pairs, f"at most {MOST_IN_EVENT} pairs of games in an event; these terms make {most}")
    if spec.lots is not None and isinstance(spec.seed, int):
        _check.fail("lots", "<64 letters>", "nothing: the seed is chosen")
    if spec.sprt is not None and (len(spec.entrants) != 2 or spec.format is Format.KNOCKOUT):
        _check.fail("sprt", f"{len(spec.entrants)} entrants, {spec.format}", "two entrants, and no knockout")


def _most_meetings(spec: Spec) -> int:
    """Meetings of the whole event."""
    n = len(spec.entrants)
    return {
        Format.ROUND_ROBIN: n * (n - 1) // 2,
        Format.GAUNTLET: spec.challengers * (n - spec.challengers),
        Format.SWISS: (spec.rounds or 0) * (n // 2),
        Format.KNOCKOUT: n - 1,
    }[spec.format]
