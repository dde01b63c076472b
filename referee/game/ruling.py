"""What the referee answers: refusals before a stroke, a ruling with its evidence after it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

from referee.game.game import Game
from referee.game.legal import Legal, legal
from referee.game.rule_id import plain_id


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why an action is not accepted. Nothing happened: no stroke, no noise, the turn and the clock run on.

    Attributes:
        rule: the rule id behind it.
        field: the part of the action, e.g. ``"call.ball"`` or ``"cue_ball"``.
        value: what came.
        allowed: what is allowed, in words.
    """

    rule: str
    field: str
    value: Any
    allowed: str

    @property
    def words(self) -> str:
        """One line for a log."""
        return f"{self.field} = {self.value!r}: must be {self.allowed} ({self.rule})"

    def to_dict(self) -> dict[str, Any]:
        """JSON form; numbers that JSON lacks (NaN, infinity) become strings."""
        return {"rule": self.rule, "field": self.field, "value": _plain(self.value), "allowed": self.allowed}


@dataclass(frozen=True, slots=True)
class Evidence:
    """What proves that a rule applied.

    Attributes:
        rule: the rule id.
        events: ordinals of the events that prove a positive fact.
        searched: first and last ordinal of the events searched in vain, for a negative fact.
        ball: the ball concerned, if one is.
        pocket: the pocket concerned, if one is.
        status: name of the stroke's status, when that is the proof (a miscue).
    """

    rule: str
    events: tuple[int, ...] = ()
    searched: tuple[int, int] | None = None
    ball: int | None = None
    pocket: int | None = None
    status: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """JSON form; the parts that say nothing are left out."""
        data: dict[str, Any] = {"rule": plain_id(self.rule)}
        if self.events:
            data["events"] = list(self.events)
        if self.searched is not None:
            data["searched"] = list(self.searched)
        for name in ("ball", "pocket", "status"):
            if getattr(self, name) is not None:
                data[name] = getattr(self, name)
        return data


@dataclass(frozen=True, slots=True)
class Ruling:
    """The referee's answer to an action.

    Attributes:
        rules: ids of the rules that decided it, the deciding ones first.
        fouls: ids of the fouls committed, the worst first; empty for a fair stroke.
        sentence: the ruling in a sentence, or what makes it when somebody reads ``words``.
        evidence: at least one entry for every rule that rests on something that happened on the table.
        game: the game as it goes on.
        made: the called ball fell in the called pocket on a fair stroke.
        rerack: the balls are to be racked: go on with ``EightBall.rerack(ruling.game, rack_seed)``.
    """

    rules: tuple[str, ...]
    fouls: tuple[str, ...]
    sentence: str | Callable[[], str] = field(repr=False, compare=False)  # it follows from the rest
    evidence: tuple[Evidence, ...]
    game: Game
    made: bool = False
    rerack: bool = False

    @property
    def words(self) -> str:
        """The ruling in a sentence."""
        if not isinstance(self.sentence, str):
            object.__setattr__(self, "sentence", self.sentence())
        assert isinstance(self.sentence, str)
        return self.sentence

    @property
    def turn(self) -> int:
        """The seat that acts next."""
        return self.game.turn

    @property
    def allowed(self) -> Legal:
        """What that seat may do."""
        return legal(self.game)

    def to_dict(self, whole: bool = True) -> dict[str, Any]:
        """JSON form; ``whole``: with what is allowed next, and the game."""
        values = {
            "rules": [plain_id(rule) for rule in self.rules],
            "fouls": [plain_id(rule) for rule in self.fouls],
            "words": self.words,
            "evidence": [evidence.to_dict() for evidence in self.evidence],
            "made": self.made,
            "rerack": self.rerack,
            "turn": self.turn,
        }
        return values | {"allowed": self.allowed.to_dict(), "game": self.game.to_dict()} if whole else values

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the sentence, not what makes it."""
        return Ruling, (self.rules, self.fouls, self.words, self.evidence, self.game, self.made, self.rerack)


def _plain(value: Any) -> Any:
    if isinstance(value, float):
        return value if isfinite(value) else str(value)
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    return value if value is None or isinstance(value, str | int | dict) else str(value)
