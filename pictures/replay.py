"""An animated replay of one shot, or of a whole game, as a single HTML file."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from typing import Any

from physics import Result
from physics.constants import N_BALLS
from pictures.balls import ball
from pictures.elements import Point, element, number
from pictures.ground import ground, nearest_hole
from pictures.projection import Projection
from pictures.theme import Theme, theme_of
from pictures.tracks import Track, tracks


@dataclass(frozen=True, slots=True)
class ReplayShot:
    """One shot of a replay.

    Attributes:
        result: of the shot, with its events.
        caption: what is said of it.
    """

    result: Result
    caption: str = ""


def html(scenes: Result | ReplayShot | Sequence[ReplayShot], *, title: str = "Replay", theme: str = "dark") -> str:
    """A page that plays the shots one after another; it loads nothing, so it can be sent as a file.

    Each ball moves along its exact path at its exact speed. Keys: space plays and pauses, left and right go from shot
    to shot.

    Args:
        scenes: one shot or several on one table, in order.
        title: of the page.
        theme: as for ``svg``.

    Raises:
        ValueError: no shots, shots on different tables, no such theme, a result without its events.
    """
    shown = _scenes(scenes)
    view, look = Projection(shown[0].result.table), theme_of(theme)
    data = json.dumps([_scene(view, scene) for scene in shown], separators=(",", ":"), allow_nan=False)
    page = files("pictures").joinpath("replay.html").read_text(encoding="utf-8")
    parts = {
        "TITLE": escape(title),
        "TABLE": _table_picture(view, look),
        "STYLE": files("pictures").joinpath("replay.css").read_text(encoding="utf-8"),
        "SCENES": data.replace("<", "\\u003c"),  # a caption cannot end the script
        "SCRIPT": files("pictures").joinpath("replay.js").read_text(encoding="utf-8"),
    }
    for name, text in parts.items():
        page = page.replace(f"<!--{name}-->", text, 1)
    return page


def _scenes(scenes: Result | ReplayShot | Sequence[ReplayShot]) -> list[ReplayShot]:
    """The shots; raises ValueError where they cannot be one replay."""
    if isinstance(scenes, Result):
        return [ReplayShot(scenes)]
    shown = [scenes] if isinstance(scenes, ReplayShot) else list(scenes)
    if not shown:
        raise ValueError("scenes = []: must be at least one shot")
    tables = {scene.result.table for scene in shown}
    if len(tables) > 1:
        raise ValueError(f"scenes = shots on {len(tables)} tables: must be on one table")
    return shown


def _table_picture(view: Projection, theme: Theme) -> str:
    """The table with all sixteen balls; the script puts them in their places."""
    across, down = view.size
    balls = [
        element("g", ball(ball_number, (0.0, 0.0), theme), id=f"ball-{ball_number}", hidden="")
        for ball_number in range(N_BALLS)
    ]
    return element(
        "svg", ground(view, theme), *balls, viewBox=f"0 0 {number(across)} {number(down)}", role="img", id="table"
    )


def _scene(view: Projection, scene: ReplayShot) -> dict[str, Any]:
    """What the script needs of one shot; places in the picture's units."""
    result = scene.result
    balls = {track.ball: _track(view, track) for track in tracks(result)}
    return {"caption": scene.caption, "duration": result.duration, "balls": balls}


def _track(view: Projection, track: Track) -> dict[str, Any]:
    """Pieces as [begins, ends, x0, y0, x1, y1, x2, y2]; when and where the ball goes: a hole, or where it leaves."""
    pieces = [
        [round(piece.begins, 6), round(piece.ends, 6), *_rounded(view, piece.start, piece.control, piece.end)]
        for piece in track.pieces
    ]
    drops = None
    if track.pocketed is not None:
        drops = [round(track.pocketed, 6), *_rounded(view, nearest_hole(view.table, track.end))]
    elif track.left is not None:
        drops = [round(track.left, 6), *_rounded(view, track.end)]
    return {"pieces": pieces, "drops": drops}


def _rounded(view: Projection, *points: Point) -> list[float]:
    return [round(value, 2) for point in points for value in view.at(point)]
