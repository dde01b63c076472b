"""A picture: a table, a position on it, or what a shot does."""

from html import escape
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics import Batch, Result, Shot, Table, TableState
from pictures.cue import cue
from pictures.elements import element, number
from pictures.ground import ground
from pictures.layers import Call, called_pocket, position, refuse_call, spread, stroke
from pictures.projection import Projection
from pictures.theme import theme_of

Shown = Table | TableState | Result


def svg(
    shown: Shown,
    *,
    table: Table | None = None,
    shot: Shot | None = None,
    call: Call | None = None,
    variants: Batch | None = None,
    theme: str = "dark",
    upright: bool = False,
    width: int | None = None,
    title: str | None = None,
) -> str:
    """A picture as SVG, to scale.

    A position is drawn with its balls. A result is drawn with the balls faint where they were, their paths, and the
    balls where they come to rest: an object ball's path has its colour, the cue ball's is dashed, a pocketed ball's
    leads into the hole. The dashed circle is the ghost ball: the cue ball as it meets the first ball.

    Args:
        shown: a table, a position, or a result that has its events.
        table: of a position; the Olympiad's if left out. A result knows its own.
        shot: its cue is drawn behind the cue ball.
        call: the called ball and pocket, ringed.
        variants: of the same stroke, such as noise makes; each leaves a dot for each ball.
        theme: ``dark`` for screens, ``light`` for paper.
        upright: the head string on top instead of on the left.
        width: in pixels; if left out, the picture is as wide as the place it is put in.
        title: what the picture is called; a description if left out.

    Raises:
        TypeError: ``shown`` is none of these.
        ValueError: no such theme, ball or pocket; a width that is not positive; a result without its events.
    """
    if not isinstance(shown, Table | TableState | Result):
        raise TypeError(f"shown = {shown!r}: must be a Table, a TableState or a Result")
    if width is not None and (isinstance(width, bool) or not isinstance(width, int) or width < 1):
        raise ValueError(f"width = {width!r}: must be a positive number of pixels")
    view, look = Projection(_table_of(shown, table), upright), theme_of(theme)
    layers = [ground(view, look)]
    if call is not None:
        refuse_call(call)
        layers.append(called_pocket(view, look, call[1]))
    if variants is not None:
        layers += spread(view, variants)
    called = None if call is None else call[0]
    if isinstance(shown, TableState):
        layers += position(view, look, shown, called)
    elif isinstance(shown, Result):
        layers += stroke(view, look, shown, called)
    at = _cue_ball(shown)
    if shot is not None and at is not None:
        layers.append(cue(view, at, shot))
    across, down = view.size
    size: dict[str, Any] = {} if width is None else {"width": width, "height": round(width * down / across)}
    return element(
        "svg",
        element("title", escape(title or described(shown))),
        *layers,
        xmlns="http://www.w3.org/2000/svg",
        viewBox=f"0 0 {number(across)} {number(down)}",
        role="img",
        **size,
    )


def png(shown: Shown, *, width: int = 1200, **options: Any) -> bytes:
    """A picture as PNG, ``width`` pixels wide; the other options are those of ``svg``.

    Raises:
        ImportError: the extra ``pictures`` is not installed.
        TypeError, ValueError: as for ``svg``.
    """
    text = svg(shown, width=width, **options)
    try:
        import resvg_py
    except ImportError as error:
        raise ImportError("PNG pictures need an extra: pip install 'pooliad[pictures]'") from error
    return bytes(resvg_py.svg_to_bytes(svg_string=text))


def pixels(shown: Shown, *, width: int = 1200, **options: Any) -> NDArray[np.uint8]:
    """A picture as (height, width, 3) red, green, blue, on white; arguments and errors are those of ``png``."""
    data = png(shown, width=width, **options)
    from PIL import Image

    picture = Image.open(BytesIO(data)).convert("RGBA")
    white = Image.new("RGBA", picture.size, "white")
    return np.asarray(Image.alpha_composite(white, picture).convert("RGB"))


def described(shown: Shown) -> str:
    """A picture in words."""
    if isinstance(shown, Table):
        return f"Table {shown.name}, {shown.length:g} m by {shown.width:g} m"
    if isinstance(shown, TableState):
        return f"Position with {len(shown.balls)} balls"
    pocketed = ", ".join(f"ball {event.ball}" for event in shown.events.of("pocket_collision"))
    return f"Shot of {shown.duration:.2f} s, {pocketed + ' pocketed' if pocketed else 'nothing pocketed'}"


def _table_of(shown: Shown, table: Table | None) -> Table:
    if isinstance(shown, TableState):
        return table or Table.olympiad()
    return shown if isinstance(shown, Table) else shown.table


def _cue_ball(shown: Shown) -> tuple[float, float] | None:
    """Where the cue ball is before the stroke, m."""
    if isinstance(shown, Table):
        return None
    x, y = (shown.start.positions if isinstance(shown, Result) else shown.positions)[0].tolist()
    return None if x != x else (x, y)
