"""The report of a calibration: one HTML page, with every shot as it was seen over what the model makes of it."""

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np

from calibration.error_model import ErrorModel
from calibration.laws import FittedLaw
from calibration.observed import Observations, ObservedShot
from calibration.result import Calibration, ExplainedShot
from calibration.shot_model import STROKE
from pictures import svg
from pictures.elements import circle, element, number
from pictures.projection import Projection
from pictures.theme import colour_of

MOST_PICTURES = 40
"""Shots that are drawn: those that are not explained come first."""
DOT = 6.0
"""Radius of a sample in a picture, mm."""
WIDE, HIGH = 640.0, 150.0
"""Of a picture of residuals, in its own units."""
STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:64rem;margin:2rem auto;padding:0 1rem;
color:#1b2420;background:#fff}
table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .7rem;border-bottom:1px solid #d4ddd8;text-align:right}
td:first-child,th:first-child,td.words{text-align:left}figure{margin:1.5rem 0}figcaption{margin:.3rem 0}
.bad{color:#a3261d;font-weight:600}svg{max-width:100%;height:auto}"""
UNITS = {"v": "m/s", "phi": "deg", "theta": "deg", "a": "mm", "b": "mm"}


def report(
    calibration: Calibration,
    observations: Observations,
    *,
    title: str = "Calibration",
    laws: Sequence[FittedLaw] = (),
    errors: ErrorModel | None = None,
) -> str:
    """The page as text; it needs no network and no second file."""
    parts = [
        f"<h1>{escape(title)}</h1>",
        _verdict(calibration),
        "<h2>Parameters</h2>",
        _parameters(calibration),
        "<h2>Correlations of their errors</h2>",
        _correlations([one.name for one in calibration.estimates], calibration.correlations),
        _laws(laws),
        _errors(errors),
        "<h2>Shots</h2>",
        _shots(calibration),
        *_pictures(calibration, observations),
    ]
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>'
    return f'<!doctype html><html lang="en"><head>{head}</head><body>{"".join(parts)}</body></html>\n'


def verdict(calibration: Calibration) -> str:
    """One sentence: whether the model explains the data."""
    shots, noise = len(calibration.shots), 1e3 * calibration.noise
    lost = len(calibration.unexplained)
    size = f"residuals are {calibration.misfit**0.5:.2f} times the noise of {noise:.2f} mm"
    if calibration.is_trusted:
        return f"The model explains {shots - lost} of {shots} shots; {size}."
    return (
        f"The model does not explain these data ({lost} of {shots} shots unexplained; {size}): "
        "a law, or a parameter that was not fitted, is wrong, or the noise is larger than told."
    )


def _verdict(calibration: Calibration) -> str:
    look = "" if calibration.is_trusted else ' class="bad"'
    return f"<p{look}>{escape(verdict(calibration))}</p>"


def _table(header: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    head = "".join(f"<th>{escape(word)}</th>" for word in header)
    body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def _parameters(calibration: Calibration) -> str:
    rows = [
        (
            one.name,
            f"{one.value:.5g}" if one.is_determined else "not determined by these data",
            f"{one.sigma:.2g}",
            f"{one.low:.5g} to {one.high:.5g}",
            f"{one.bootstrap[0]:.5g} to {one.bootstrap[1]:.5g}",
            f"{one.before:.5g}",
        )
        for one in calibration.estimates
    ]
    return _table(("parameter", "value", "standard error", "95 % interval", "by the bootstrap", "before"), rows)


def _correlations(names: Sequence[str], matrix: np.ndarray) -> str:
    rows = [(name, *(f"{value:.2f}" for value in row)) for name, row in zip(names, matrix.tolist(), strict=True)]
    return _table(("", *names), rows)


def _laws(laws: Sequence[FittedLaw]) -> str:
    if not laws:
        return ""
    rows = [
        (
            one.law,
            f"{one.calibration.misfit**0.5:.2f}",
            f"{one.worse:.2f} +- {one.error:.2f}",
            f"{100.0 * one.followed:.0f} %",
            "refuted by these data" if one.is_refuted else "",
        )
        for one in laws
    ]
    header = ("law", "residuals, in noise", "mean square worse by", "shots explained", "")
    return "<h2>Laws</h2>" + _table(header, rows)


def _errors(errors: ErrorModel | None) -> str:
    if errors is None:
        return ""
    rows = [
        (
            f"{name}, {UNITS[name]}",
            f"{errors.sigmas[name]:.3g}" if errors.told[name] else "not told by these data",
            "{:.3g} to {:.3g}".format(*errors.intervals[name]),
            f"{errors.means[name]:.3g}",
        )
        for name in STROKE
    ]
    header = ("parameter", "standard deviation", "95 % interval", "mean")
    return (
        f"<h2>Errors of {errors.strokes} strokes</h2>"
        + _table(header, rows)
        + _correlations(STROKE, errors.correlations)
    )


def _shots(calibration: Calibration) -> str:
    rows = [
        (shot.name, f"{shot.rms:.2f}", str(shot.outliers), "yes" if shot.is_explained else f"no: {shot.why}")
        for shot in calibration.shots
    ]
    return _table(("shot", "residuals, in noise", "outliers", "explained"), rows)


def _pictures(calibration: Calibration, observations: Observations) -> list[str]:
    pairs = list(zip(calibration.shots, observations.shots, strict=True))
    pairs.sort(key=lambda pair: pair[0].is_explained)  # stable: else in the order of the data
    return [_figure(shot, seen) for shot, seen in pairs[:MOST_PICTURES] if shot.result is not None]


def _figure(shot: ExplainedShot, seen: ObservedShot) -> str:
    assert shot.result is not None
    view = Projection(shot.result.table, upright=False)
    dots = [
        circle(view.at((x, y)), DOT, fill=colour_of(ball), stroke="#16161a", stroke_width=1.5)
        for (x, y), ball in zip(seen.places.tolist(), seen.balls.tolist(), strict=True)
    ]
    picture = svg(shot.result, shot=shot.stroke, theme="light", title=f"Shot {shot.name}")
    drawn = picture.removesuffix("</svg>") + "".join(dots) + "</svg>"
    words = f"Shot {shot.name}: samples as dots over the model's paths. {shot.why}"
    return f"<figure>{drawn}{_residuals(shot, seen)}<figcaption>{escape(words)}</figcaption></figure>"


def _residuals(shot: ExplainedShot, seen: ObservedShot) -> str:
    """Residuals over time, mm: x as filled dots, y as rings."""
    span = max(1e-9, float(np.ptp(seen.times)))
    size = 1e3 * max(1e-6, float(np.abs(shot.residuals).max()))
    marks = []
    for time, ball, (x, y) in zip(seen.times.tolist(), seen.balls.tolist(), shot.residuals.tolist(), strict=True):
        across = 40.0 + (WIDE - 50.0) * (time - float(seen.times.min())) / span
        for value, look in (
            (x, {"fill": colour_of(ball), "stroke": "#16161a"}),
            (y, {"fill": "none", "stroke": colour_of(ball)}),
        ):
            marks.append(circle((across, 0.5 * HIGH - 0.45 * HIGH * 1e3 * value / size), 2.5, **look))
    zero = element("path", d=f"M40 {number(0.5 * HIGH)}H{number(WIDE)}", stroke="#6f8a7e")
    label = element("text", f"{size:.1f} mm", x=0, y=14, font_size=12)
    text = element("text", escape(f"{span:.2f} s"), x=WIDE - 45.0, y=HIGH - 4.0, font_size=12)
    box = f"0 0 {number(WIDE)} {number(HIGH)}"
    return element(
        "svg",
        element("title", f"Residuals of shot {escape(shot.name)}"),
        zero,
        label,
        text,
        *marks,
        viewBox=box,
        role="img",
    )
