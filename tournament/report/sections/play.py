"""How everybody played: fouls, thinking time, luck."""

from collections.abc import Sequence

from referee.game import RULES
from tournament.report import legends
from tournament.report.blocks import note, table
from tournament.report.data import Data


def fouls(data: Data) -> str:
    """Fouls by entrant and by rule, and what those rules say."""
    fouls = data["fouls"]
    rules = sorted({rule for one in fouls for rule in one["rules"]})
    rows = [
        (one["name"], one["strokes"], one["fouls"], _per(one["fouls"], one["strokes"], 100), *_each(one, rules))
        for one in fouls
    ]
    heads = ("Name", "Strokes", "Fouls", "in 100 strokes", *rules)
    meaning = [(rule, RULES.get(rule, "a rule of another version")) for rule in rules]
    legend = table("What the rules say", ("Rule", "Meaning"), meaning, texts=2) if rules else ""
    return table("Fouls by rule; one stroke can break several", heads, rows) + legend


def _each(one: Data, rules: Sequence[str]) -> list[int]:
    return [one["rules"].get(rule, 0) for rule in rules]


def _per(count: float, whole: float, times: float = 1.0) -> str:
    return f"{times * count / whole:.2f}" if whole else "–"


def thinking_time(data: Data) -> str:
    """Seconds and simulated shots by entrant."""
    rows = [
        (
            one["name"],
            one["games"],
            f"{one['seconds']:.1f}",
            _per(one["seconds"], one["games"]),
            f"{one['longest']:.1f}",
            _per(one["seconds"], one["strokes"]),
            _per(one["simulated"], one["games"]),
        )
        for one in data["time"]
    ]
    heads = ("Name", "Games", "Seconds", "a game", "longest game", "a stroke", "Simulated shots a game")
    return table("Thinking time and simulated shots", heads, rows, says=legends.TIME)


def luck(data: Data) -> str:
    """What noise gave and took; empty where it was not looked for."""
    if not data["luck"]:
        return ""
    rows = [
        (one["name"], one["games"], one["pairs"], *(_three(one[key]) for name in _LUCK for key in name))
        for one in data["luck"]
    ]
    about = (
        "Luck of a stroke is the value of its outcome less the mean value over fresh noise draws of the same intended "
        "shot, the value function fixed before the event. Its mean is zero, so the share without luck estimates the "
        "same, with less noise. Intervals are Student's, of 95 % confidence, over pairs of games, from two pairs that "
        "differ."
    )
    heads = ("Name", "Games", "Pairs", "Share of points", "from", "to", "of it luck", "from", "to", "without luck")
    return table("Luck a game, in points", (*heads, "from", "to"), rows, says=legends.LUCKY) + note(about)


_LUCK = tuple((name, f"{name}_low", f"{name}_high") for name in ("score", "luck", "corrected"))


def _three(value: float | None) -> str:
    return "–" if value is None else f"{value:.3f}"
