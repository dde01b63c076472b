"""Who is stronger, and how sure that is: ratings, meetings, and what noise made of them."""

from collections.abc import Callable

from tournament.report import legends
from tournament.report.blocks import beside, figure, note, table
from tournament.report.data import Data
from tournament.report.svg import Line, Whisker, dots, lines

MOST_ROWS = 24
"""Entrants in a plot and in the cross table: more cannot be read. The tables below them and the JSON have all."""
MOST_LINES = 8


def ladder(data: Data) -> str:
    """A server's ladder."""
    rows = [(one["name"], one["ordinal"], one["mu"], one["sigma"], one["games"]) for one in data["ladder"]]
    about = "Plackett-Luce skills that move with every game; sorted by mu - 3 sigma"
    return table(about, ("Name", "Ordinal", "mu", "sigma", "Games"), rows)


def ratings(data: Data) -> str:
    """Bradley-Terry ratings with their intervals, drawn and as a table."""
    ratings = data["ratings"]
    if not data["games"]:
        return note("No games yet.")
    if not ratings:
        return note("Nobody is rated by an event whose racks and noise could be foreseen.")
    shown = [Whisker(one["name"], *(one[key] for key in _INTERVALS)) for one in ratings[:MOST_ROWS]]
    about = "A dot for each rating, a whisker for its marginal 95 % interval, a thin one for the simultaneous interval."
    scores = {one["name"]: _score(one) for one in data["scores"]}
    rows = [
        (
            one["name"],
            *(f"{one[key]:+.0f}" for key in _INTERVALS),
            f"{one['best_rank']} to {one['worst_rank']}",
            one["games"],
            *scores[one["name"]],
        )
        for one in ratings
    ]
    heads = ("Name", "Elo", "from", "to", "all: from", "to", "Rank", "Games", "Share of points", "from", "to", "Pairs")
    caption = "Bradley-Terry ratings, and each entrant's share of the points"
    plot = dots("ratings", "Ratings", about, shown, "Elo above the mean")
    return figure(plot, about) + table(caption, heads, rows, says=legends.RATINGS) + _dispersion(data)


_INTERVALS = ("elo", "low", "high", "simultaneous_low", "simultaneous_high")


def _dispersion(data: Data) -> str:
    factor, check = data["dispersion"], data["bootstrap_dispersion"]
    words = f"Points of pairs vary {factor:.2f} times as much as those of two independent games without draws would."
    if check is not None:
        words += (
            f" A bootstrap over pairs, as a check, says {check:.2f}: were it far off, one factor would not do for all, "
            "and some intervals would be too narrow."
        )
    return note(words)


def superiority(data: Data) -> str:
    """How likely everybody is stronger than everybody else."""
    if not data["games"] or not data["superiority"]["names"]:
        return ""
    names, rows = data["superiority"]["names"][:MOST_ROWS], data["superiority"]["likelihoods"][:MOST_ROWS]
    cells = [
        (name, *("" if at == place else f"{100.0 * likelihood:.1f}" for at, likelihood in enumerate(row[:MOST_ROWS])))
        for place, (name, row) in enumerate(zip(names, rows, strict=True))
    ]
    return table("Likelihood in per cent that the row's entrant is stronger than the column's", ("Name", *names), cells)


def _score(score: Data) -> tuple[str, str, str, int]:
    return f"{score['score']:.3f}", f"{score['low']:.3f}", f"{score['high']:.3f}", score["pairs"]


def cross_table(data: Data) -> str:
    """Points of everybody against everybody, then each meeting by itself."""
    names = [one["name"] for one in data.get("standings") or data["ladder"]][:MOST_ROWS]
    points = {}
    for meeting in data["meetings"]:
        one, other = meeting["players"]
        points[one, other] = f"{meeting['points'][0]:g}/{meeting['games']}"
        points[other, one] = f"{meeting['points'][1]:g}/{meeting['games']}"
    rows = [(name, *(points.get((name, other), "") for other in names)) for name in names]
    cross = table("Points of the row's player / games against the column's", ("Name", *names), rows)
    pairs = [
        (
            *meeting["players"],
            *_score(meeting),
            *(_elo(meeting[key]) for key in ("elo", "elo_low", "elo_high")),
            f"{100 * meeting['superiority']:.1f} %",
        )
        for meeting in data["meetings"]
    ]
    heads = ("Player", "against", "Share", "from", "to", "Pairs", "Elo", "from", "to", "Superiority")
    about = "Each meeting, from the side of the player named first"
    return cross + table(about, heads, pairs, texts=2, says=legends.MEETINGS)


def _elo(value: float) -> str:
    """An Elo difference, its cut-off marked."""
    from tournament.statistics import MOST_ELO

    return f"{value:+.0f}" if abs(value) < MOST_ELO else ("≥ " if value > 0 else "≤ ") + f"{value:+.0f}"


def noise(data: Data) -> str:
    """Shares of the points by noise level; empty where all games had the same."""
    rows = data["noise"]
    if len({(row["from"], row["to"]) for row in rows}) < 2:
        return ""
    names = [one["name"] for one in data["ratings"] or data["standings"]][:MOST_LINES]
    middle: Callable[[Data], float] = lambda row: (row["from"] + row["to"]) / 2.0  # noqa: E731
    drawn = [
        Line(name, tuple((middle(row), row["points"] / row["games"], row["low"], row["high"]) for row in mine))
        for name in names
        if (mine := [row for row in rows if row["name"] == name])
    ]
    about = "A line for each entrant: share of the points at each noise level, with 95 % intervals from pairs."
    plot = lines("noise", "Score against noise level", about, drawn, "noise level", "share of points")
    cells = [
        (
            row["name"],
            f"{row['from']:g}" if row["from"] == row["to"] else f"{row['from']:g} to {row['to']:g}",
            f"{row['points'] / row['games']:.3f}",
            f"{row['low']:.3f}",
            f"{row['high']:.3f}",
            row["games"],
        )
        for row in rows
    ]
    heads = ("Name", "Level", "Share of points", "from", "to", "Games")
    return beside(
        figure(plot, "Share of the points at each level, with 95 % intervals"), table("The same", heads, cells)
    )
