"""Strokes and decisions of the past, as answers, views and histories show them."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Self, TypeVar

from pydantic import Field

from physics.events import EventKind
from protocol.outcomes import EventView, Pocketed, RulingView
from protocol.shots import ShotParameters, SubmittedAction
from protocol.values import Balls, Flag, Integer, Message, Number, Seat, trusted
from referee.play.stroke import Stroke


class StrokeView(Message):
    """A stroke or a decision in the past.

    Attributes:
        index: its number in the game's history, from 0; decisions count.
        stroke: the index of the stroke; null for a decision.
        seat: who played it.
        action: what was asked for.
        shot: the shot as played, with noise; null for a decision.
        status: how the shot ended, by name (``at_rest``, ``tip_off_ball``, …); null for a decision.
        duration: s; null for a decision.
        pocketed: in order.
        miscue: the tip slipped off the cue ball, which is no foul of its own; left out where it did not.
        balls: the table after the ruling (balls spotted, racked again).
    """

    index: Integer
    stroke: Integer | None
    seat: Seat
    action: SubmittedAction
    shot: ShotParameters | None
    status: str | None
    duration: Number | None
    pocketed: tuple[Pocketed, ...]
    miscue: Annotated[Flag, Field(exclude_if=lambda slipped: not slipped)] = False
    ruling: RulingView
    balls: Balls

    @classmethod
    def of(cls, stroke: Stroke, index: int) -> Self:
        """The wire's form of the ``index``-th entry of a game's history."""
        return trusted(cls, **_summary(stroke, index))

    @classmethod
    def of_entry(cls, entry: Mapping[str, Any]) -> Self:
        """The same from the object of its line in a record (``referee.record.stroke_entry``)."""
        return cls.model_validate(_recorded(entry))


class StrokeDetail(StrokeView):
    """A stroke with its events.

    Attributes:
        before: the table the stroke was played on, the cue ball placed; null for a decision.
        final: the table at rest, before the ruling touched it; null for a decision.
        events: every event of the shot; empty for a decision.
    """

    before: Balls | None
    final: Balls | None
    events: tuple[EventView, ...]

    @classmethod
    def of(cls, stroke: Stroke, index: int, *, events: bool = True) -> Self:
        """The wire's form of the ``index``-th entry of a game's history; ``events``: with its events."""
        result = stroke.result
        details: dict[str, Any] = {"before": None, "final": None, "events": ()}
        if result is not None:
            details = {
                "before": stroke.before.to_dict(),
                "final": result.final.to_dict(),
                "events": tuple(event.to_dict() for event in result.events) if events else (),
            }
        return cls.model_validate(_summary(stroke, index) | details)

    @classmethod
    def of_entry(cls, entry: Mapping[str, Any]) -> Self:
        """The same from the object of its line in a record (``referee.record.stroke_entry``)."""
        details = {"before": _by_number(entry.get("before")), "final": _by_number(entry.get("final"))}
        return cls.model_validate(_recorded(entry) | details | {"events": entry.get("events", ())})


Played = TypeVar("Played", Stroke, StrokeView)


def since_own_last(strokes: Sequence[Played], seat: int | None) -> tuple[Played, ...]:
    """The strokes a view shows: from the reader's own last one on; for a spectator (None) the last alone."""
    if seat is None:
        return tuple(strokes[-1:])
    own = (place for place in range(len(strokes) - 1, -1, -1) if strokes[place].seat == seat)
    return tuple(strokes[next(own, 0) :])


def _recorded(entry: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of `_summary`, from the object of a record's line."""
    fallen = (event for event in entry.get("events", ()) if event["kind"] == EventKind.POCKET_COLLISION)
    return {
        "index": entry["entry"],
        "stroke": entry["stroke"],
        "seat": entry["seat"],
        "action": entry["action"],
        "shot": entry.get("shot"),
        "status": entry.get("status"),
        "duration": entry.get("duration"),
        "pocketed": [{"ball": event["ball"], "pocket": event["other"]} for event in fallen],
        "miscue": entry.get("miscue", False),
        "ruling": entry["ruling"],
        "balls": _by_number(entry["game"]["state"]),
    }


def _by_number(balls: Mapping[str, Any] | None) -> dict[str, Any] | None:
    """A record's names are in the order of letters, 10 before 2."""
    return None if balls is None else {ball: balls[ball] for ball in sorted(balls, key=int)}


def _summary(stroke: Stroke, index: int) -> dict[str, Any]:
    """The fields that a stroke has with and without its events."""
    result = stroke.result
    fallen = () if result is None else result.facts.pocketed_in_order
    return {
        "index": index,
        "stroke": stroke.index,
        "seat": stroke.seat,
        "action": SubmittedAction.of(stroke.action),
        "shot": None if stroke.shot is None else ShotParameters.of(stroke.shot),
        "status": None if result is None else result.status.name.lower(),
        "duration": None if result is None else result.duration,
        "pocketed": tuple([trusted(Pocketed, ball=ball, pocket=pocket) for ball, pocket, _ in fallen]),
        "miscue": result is not None and result.facts.miscue == 1,
        "ruling": RulingView.of(stroke.ruling),
        "balls": stroke.game.state.by_ball(),
    }
