"""How a stroke was ruled, and how a game ended."""

from typing import Annotated, Literal

from pydantic import Field

from physics.events import Event
from protocol.values import BallNumber, Integer, Message, Number, PocketNumber, Seat, trusted
from referee.game import EndReason, Evidence, Outcome, Ruling


class OutcomeView(Message):
    """The end of a game.

    Attributes:
        winner: seat; null for a draw.
        reason: why it ended.
        rule: the rule id that decided it.
    """

    winner: Seat | None
    reason: EndReason
    rule: str

    @classmethod
    def of(cls, outcome: Outcome) -> "OutcomeView":
        """The wire's form of an outcome."""
        return cls(winner=outcome.winner, reason=outcome.reason, rule=outcome.rule)


class EvidenceView(Message):
    """What proves that a rule applied.

    Attributes:
        rule: its id.
        events: ordinals of the events that prove it.
        searched: first and last ordinal of the events searched in vain.
        ball, pocket: those concerned. status: of the stroke, when that is the proof.
    """

    rule: str
    events: tuple[Integer, ...] = ()
    searched: tuple[Integer, Integer] | None = None
    ball: BallNumber | None = None
    pocket: PocketNumber | None = None
    status: str | None = None

    @classmethod
    def of(cls, evidence: Evidence) -> "EvidenceView":
        """The wire's form of a proof."""
        return trusted(
            cls,
            rule=evidence.rule,
            events=evidence.events,
            searched=evidence.searched,
            ball=evidence.ball,
            pocket=evidence.pocket,
            status=evidence.status,
        )


class RulingView(Message):
    """The referee's ruling on a stroke or a decision.

    Attributes:
        rules: ids of the rules that decided it (docs/rules.md).
        fouls: the fouls among them; empty for a legal stroke.
        words: a sentence.
        evidence: per rule, the events that prove it, or the range of events searched in vain.
        made: whether the called ball fell in the called pocket on a fair stroke.
        rerack: whether the balls were racked again after it.
        turn: the seat that acts next.
    """

    rules: tuple[str, ...]
    fouls: tuple[str, ...]
    words: str
    evidence: tuple[EvidenceView, ...]
    made: bool
    rerack: bool
    turn: Seat

    @classmethod
    def of(cls, ruling: Ruling) -> "RulingView":
        """The wire's form of a ruling."""
        return trusted(
            cls,
            rules=ruling.rules,
            fouls=ruling.fouls,
            words=ruling.words,
            evidence=tuple([EvidenceView.of(item) for item in ruling.evidence]),
            made=ruling.made,
            rerack=ruling.rerack,
            turn=ruling.turn,
        )


def _is_none(value: float | None) -> bool:
    return value is None


class BallStateView(Message):
    """One ball after an event: m, m/s, rad/s.

    Attributes:
        height: m, of the centre above where it rests on the cloth. velocity_z: m/s, upwards. Both are left out on
            tables where nothing flies.
    """

    ball: BallNumber
    position: tuple[Number, Number]
    velocity: tuple[Number, Number]
    spin: tuple[Number, Number, Number]
    motion: Literal["stationary", "spinning", "sliding", "rolling", "pocketed", "absent", "flying", "driven_off"]
    height: Annotated[Number | None, Field(exclude_if=_is_none)] = None
    velocity_z: Annotated[Number | None, Field(exclude_if=_is_none)] = None


class EventView(Message):
    """One event of a shot; between events every ball moves in closed form (docs/physics.md)."""

    index: Integer
    time: Annotated[Number, Field(description="s since the strike.")]
    kind: str
    ball: BallNumber
    other: Annotated[Integer, Field(description="The other ball, cushion or pocket; -1 if none.")]
    states: tuple[BallStateView, ...]

    @classmethod
    def of(cls, event: Event) -> "EventView":
        """The wire's form of an event."""
        return cls.model_validate(event.to_dict())


class Pocketed(Message):
    """A ball that went down in a stroke."""

    ball: BallNumber
    pocket: PocketNumber
