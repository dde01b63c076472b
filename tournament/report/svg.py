"""Two plots as inline SVG: dots with whiskers, and lines with whiskers. No script, no font, no request.

Colours are those of the page (``currentColor`` and its variables), so that plots follow light and dark. Every plot is
an image with a title and a description; the page has the same figures in a table beside it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise

WIDTH = 720
ROW = 30
LABEL = 190
"""Pixels for the names at the left; longer ones are cut, the table has them whole."""
LETTERS = 22
MARGIN = 40
COLOURS = 8


@dataclass(frozen=True, slots=True)
class Whisker:
    """A row of a dot plot: a value, its interval, and a wider one."""

    label: str
    value: float
    low: float
    high: float
    least: float
    most: float


@dataclass(frozen=True, slots=True)
class Line:
    """A line: points (x, y, low, high)."""

    label: str
    points: tuple[tuple[float, float, float, float], ...]


def dots(identity: str, title: str, about: str, rows: Sequence[Whisker], unit: str, zero: float | None = 0.0) -> str:
    """A dot, a whisker and a longer thin one for each row, top down.

    Args:
        identity: unique in the page.
        title, about: what it shows, in words.
        rows: at least one.
        unit: under the axis.
        zero: a line to compare with.
    """
    marks = [one for row in rows for one in (row.least, row.most)] + ([] if zero is None else [zero])
    scale = _Scale(min(marks), max(marks), LABEL, WIDTH - MARGIN)
    height = ROW * len(rows) + 50
    parts = [_axis(scale, height - 40, unit, top=6.0)]
    if zero is not None:
        parts.append(f'<line class="zero" x1="{scale(zero)}" x2="{scale(zero)}" y1="6" y2="{height - 40}"/>')
    for index, row in enumerate(rows):
        y = ROW * index + 20
        parts.append(f'<text x="{LABEL - 12}" y="{y + 4}" text-anchor="end">{escape(_cut(row.label))}</text>')
        for kind, low, high in (("whisker thin", row.least, row.most), ("whisker", row.low, row.high)):
            parts.append(f'<line class="{kind}" x1="{scale(low)}" x2="{scale(high)}" y1="{y}" y2="{y}"/>')
        parts.append(f'<circle class="c0" cx="{scale(row.value)}" cy="{y}" r="5"/>')
    return _image(identity, title, about, height, parts)


def lines(identity: str, title: str, about: str, rows: Sequence[Line], x_unit: str, y_unit: str) -> str:
    """Lines over a shared x axis, y from 0 to 1; each is labelled at its right end.

    Args:
        identity, title, about: as for ``dots``.
        rows: at least one, each with at least one point.
        x_unit, y_unit: what the axes are.
    """
    xs = [point[0] for row in rows for point in row.points]
    across = _Scale(min(xs), max(xs), 56, WIDTH - LABEL)
    up = _Scale(0.0, 1.0, 300, 14)
    parts = [_axis(across, 310, x_unit, top=14.0), _levels(up, WIDTH - LABEL, y_unit)]
    ends = _spread([up(row.points[-1][1]) for row in rows])
    for index, (row, end) in enumerate(zip(rows, ends, strict=True)):
        parts += _drawn(row, across, up, f"c{index % COLOURS}", 4.0 * (index - (len(rows) - 1) / 2.0))
        parts.append(
            f'<text class="c{index % COLOURS}" x="{WIDTH - LABEL + 14}" y="{end + 4}">{escape(_cut(row.label))}</text>'
        )
    return _image(identity, title, about, 350, parts)


class _Scale:
    """A linear scale from values to pixels; equal ends are moved apart."""

    def __init__(self, low: float, high: float, start: float, stop: float) -> None:
        if high <= low:
            low, high = low - 0.5, high + 0.5
        self.low, self.high, self._start, self._stop = low, high, start, stop

    def __call__(self, value: float) -> float:
        share = (value - self.low) / (self.high - self.low)
        return round(self._start + share * (self._stop - self._start), 1)

    def ticks(self) -> list[float]:
        """About five round values."""
        step = _round_step((self.high - self.low) / 5.0)
        first = -(-self.low // step)
        return [round((first + index) * step, 10) for index in range(int((self.high - first * step) / step) + 1)]


def _round_step(step: float) -> float:
    """The next of 1, 2, 5 times a power of ten."""
    power = 10.0 ** (len(str(int(step))) - 1) if step >= 1.0 else 1.0
    while step < power:
        power /= 10.0
    return next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= step)


def _axis(scale: _Scale, y: float, unit: str, top: float) -> str:
    """The horizontal axis with its grid."""
    ticks = "".join(
        f'<line class="grid" x1="{scale(tick)}" x2="{scale(tick)}" y1="{top}" y2="{y}"/>'
        f'<text x="{scale(tick)}" y="{y + 16}" text-anchor="middle">{tick:g}</text>'
        for tick in scale.ticks()
    )
    middle = (scale(scale.low) + scale(scale.high)) / 2.0
    return f'{ticks}<text x="{middle}" y="{y + 34}" text-anchor="middle">{escape(unit)}</text>'


def _levels(scale: _Scale, right: float, unit: str) -> str:
    """The vertical axis of scores with its grid."""
    rows = "".join(
        f'<line class="grid" x1="56" x2="{right}" y1="{scale(level)}" y2="{scale(level)}"/>'
        f'<text x="46" y="{scale(level) + 4}" text-anchor="end">{level:g}</text>'
        for level in (0.0, 0.25, 0.5, 0.75, 1.0)
    )
    return f'{rows}<text x="62" y="10">{escape(unit)}</text>'


def _drawn(row: Line, across: _Scale, up: _Scale, colour: str, aside: float) -> list[str]:
    """One line with whiskers, a little to the side so that whiskers do not cover each other."""
    spots = [(across(x) + aside, up(y), up(low), up(high)) for x, y, low, high in row.points]
    parts = [
        f'<line class="stroke {colour}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>'
        for (x1, y1, _, _), (x2, y2, _, _) in pairwise(spots)
    ]
    for x, y, low, high in spots:
        parts.append(f'<line class="stroke thin {colour}" x1="{x}" x2="{x}" y1="{low}" y2="{high}"/>')
        parts.append(f'<circle class="{colour}" cx="{x}" cy="{y}" r="4"/>')
    return parts


def _spread(places: Sequence[float]) -> list[float]:
    """The same heights, at least 16 pixels apart, so that labels can be read."""
    order = sorted(range(len(places)), key=lambda index: places[index])
    spread, last = [0.0] * len(places), -16.0
    for index in order:
        last = max(places[index], last + 16.0)
        spread[index] = last
    return spread


def _cut(text: str) -> str:
    return text if len(text) <= LETTERS else text[: LETTERS - 1] + "…"


def _image(identity: str, title: str, about: str, height: float, parts: Sequence[str]) -> str:
    return (
        f'<svg class="plot" role="img" aria-labelledby="{identity}-t {identity}-d" viewBox="0 0 {WIDTH} {height:g}">'
        f'<title id="{identity}-t">{escape(title)}</title><desc id="{identity}-d">{escape(about)}</desc>'
        f"{''.join(parts)}</svg>"
    )
