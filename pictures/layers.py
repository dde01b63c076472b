"""What lies on the table in a picture: balls, paths, what was called, a spread of variants."""

import numpy as np

from physics import Batch, EventKind, Result, TableState
from physics.constants import N_BALLS, N_POCKETS
from pictures.balls import ball, ghost, ring
from pictures.elements import Point, circle, element, place
from pictures.ground import hole_of, nearest_hole
from pictures.projection import MM, Projection
from pictures.theme import Theme, colour_of
from pictures.tracks import Track, tracks

FAINT = 0.6
"""Opacity of a ball where a shot has left it from."""

LINE, CASING = 7.0, 12.0
"""Widths of a path and of what sets it off the cloth, mm."""

DOT = 9.0
"""Radius of a dot of a spread, mm."""

Call = tuple[int, int]
"""A called ball and pocket."""


def refuse_call(call: Call) -> None:
    """Raise ValueError unless this names an object ball and a pocket."""
    for name, value, least, most in (("ball", call[0], 1, N_BALLS - 1), ("pocket", call[1], 0, N_POCKETS - 1)):
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            raise ValueError(f"call.{name} = {value!r}: must be an integer from {least} to {most}")


def called_pocket(view: Projection, theme: Theme, pocket: int) -> str:
    """A ring round a hole."""
    centre, radius = hole_of(view.table.pockets[pocket])
    return circle(view.at(centre), radius * MM + 6.0, fill="none", stroke=theme.call, stroke_width=8.0)


def position(view: Projection, theme: Theme, state: TableState, called: int | None) -> list[str]:
    """Balls at rest."""
    places = {number: view.at((x, y)) for number in state.balls for x, y in [state.positions[number].tolist()]}
    drawn = [ball(number, at, theme) for number, at in places.items()]
    return [*drawn, *([ring(places[called], theme)] if called in places else [])]


def stroke(view: Projection, theme: Theme, result: Result, called: int | None) -> list[str]:
    """The balls faint where they were, their paths, the ghost ball, and the balls where they lie in the end."""
    all_tracks = tracks(result)
    moved = [track for track in all_tracks if track.moves]
    at_first = [ball(track.ball, view.at(track.start), theme, FAINT) for track in moved]
    at_last = [ball(track.ball, view.at(track.end), theme) for track in all_tracks if track.stays]
    rings = [ring(view.at(track.start), theme) for track in all_tracks if track.ball == called]
    meeting = _ghost_place(result)
    return [
        *(_path(view, theme, track) for track in moved),
        *at_first,
        *([] if meeting is None else [ghost(view.at(meeting), theme)]),
        *at_last,
        *rings,
    ]


def spread(view: Projection, batch: Batch) -> list[str]:
    """A dot for every ball where one of many strokes leaves it, those that none of them moved left out."""
    groups = []
    for number in range(N_BALLS):
        places = batch.positions[:, number]
        places = places[~np.isnan(places[:, 0])]
        if len(places) > 0 and (places != places[0]).any():
            dots = [circle(view.at((x, y)), DOT) for x, y in places.tolist()]
            groups.append(element("g", *dots, fill=colour_of(number), opacity="0.45"))
    return groups


def _ghost_place(result: Result) -> Point | None:
    """Where the cue ball is when it first meets another."""
    for event in result.events:
        if event.kind is EventKind.BALL_COLLISION and event.ball == 0:
            return event.states[0].position
    return None


def _path(view: Projection, theme: Theme, track: Track) -> str:
    """A ball's way; a pocketed one's ends in the hole."""
    text = "M" + place(view.at(track.start))
    for piece in track.pieces:
        text += f"Q{place(view.at(piece.control))} {place(view.at(piece.end))}"
    if track.pocketed is not None:
        text += "L" + place(view.at(nearest_hole(view.table, track.end)))
    look = {"fill": "none", "stroke_linejoin": "round"}
    if track.ball == 0:
        return element("path", d=text, stroke=theme.cue_line, stroke_width=LINE, stroke_dasharray="22 13", **look)
    casing = element("path", d=text, stroke=theme.casing, stroke_width=CASING, opacity="0.5")
    line = element("path", d=text, stroke=colour_of(track.ball), stroke_width=LINE)
    return element("g", casing, line, **look)
