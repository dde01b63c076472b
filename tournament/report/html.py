"""The report as one page: HTML with inline plots and style, no script, no request to anywhere.

Every text that comes from outside (names, records, rule ids) passes ``text``, which escapes it; a record becomes a link
only if it is a web address or a plain relative path.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from html import escape
from importlib.resources import files
from types import MappingProxyType
from typing import Any
from urllib.parse import quote

from physics import Table
from referee.game import RULES
from tournament.report import legends
from tournament.report.data import Data
from tournament.report.svg import Line, Whisker, dots, lines

MOST_ROWS = 24
"""Entrants in a plot and in the cross table: more cannot be read. The tables below them and the JSON have all."""
MOST_LINES = 8
MOST_GAMES = 2000
"""Games listed in the page; the JSON and the comma-separated values have all."""

_NONE: Mapping[str, str] = MappingProxyType({})
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
_WEB = re.compile(r"https?://[^\s]+", re.IGNORECASE)
_PATH = re.compile(r"(?!/)(?!.*(?:^|/)\.\.(?:/|$))[\w.,=+@ -]+(?:/[\w.,=+@ -]+)*")


def text(value: Any) -> str:
    """Any value as text of a page, never markup."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return escape(f"{value:.4g}" if isinstance(value, float) else str(value))


def page(data: Data) -> str:
    """The whole page for ``event_report`` or ``server_report``."""
    style = files("tournament.report").joinpath("style.css").read_text(encoding="utf-8")
    bodies = [(title, make(data)) for title, make in (_EVENT if data["kind"] == "event" else _SERVER)]
    sections = "\n".join(
        f"<section{_HALF if title in _NARROW else ''}>\n<h2>{title}</h2>\n{body}\n</section>"
        for title, body in bodies
        if body
    )
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{text(data['name'])}</title>\n<style>\n{style}</style></head>\n"
        f"<body><main>\n<h1>{text(data['name'])}</h1>\n{sections}\n</main></body></html>\n"
    )


def table(
    caption: str, heads: Sequence[str], rows: Iterable[Sequence[Any]], texts: int = 1, says: Mapping[str, str] = _NONE
) -> str:
    """A table; the first ``texts`` columns are texts, the others numbers. Cells are escaped here.

    ``says`` tells below the table what columns mean, those that it has.
    """
    marks = [' class="text"' if index < texts else "" for index in range(len(heads))]
    head = "".join(f'<th scope="col"{mark}>{text(name)}</th>' for mark, name in zip(marks, heads, strict=True))
    body = "".join(_cells(row, marks) for row in rows)
    return (
        f'<div class="wide" tabindex="0"><table><caption>{text(caption)}</caption>'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>{_legend(heads, says)}"
    )


def _legend(heads: Sequence[str], says: Mapping[str, str]) -> str:
    meanings = [(name, meaning) for name, meaning in says.items() if name in heads]
    rows = "".join(f"<div><dt>{text(name)}</dt><dd>{text(meaning)}</dd></div>" for name, meaning in meanings)
    return f'<dl class="says">{rows}</dl>' if rows else ""


def link(address: str, words: str) -> str:
    """A link, as text if it leads neither to a web address nor to a plain relative path; nothing without an address."""
    if _WEB.fullmatch(address):
        return f'<a href="{escape(address)}" rel="noreferrer">{text(words)}</a>'
    if _PATH.fullmatch(address):
        return f'<a href="{escape(quote(address))}">{text(words)}</a>'
    return text(address)


def _cells(row: Sequence[Any], marks: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<td{mark}>{text(cell)}</td>" for mark, cell in zip(marks, row, strict=True)) + "</tr>"


def _figure(plot: str, caption: str) -> str:
    return f'<figure tabindex="0">{plot}<figcaption>{text(caption)}</figcaption></figure>'


def _beside(*parts: str) -> str:
    """Beside one another where there is room."""
    return f'<div class="beside">{"".join(f"<div>{part}</div>" for part in parts if part)}</div>'


def _note(words: str) -> str:
    return f'<p class="note">{text(words)}</p>'


def _terms(data: Data) -> str:
    terms, state = data["terms"], data["state"]
    noise = terms["noise"]
    levels = noise.get("levels") or f"drawn from {noise['range'][0]:g} to {noise['range'][1]:g}"
    rows = [
        ("Format", terms["format"].replace("_", " ") + (f", {terms['rounds']} rounds" if terms["rounds"] else "")),
        ("Entrants", len(terms["entrants"])),
        ("Pairs of games in a meeting", terms["pairs"]),
        ("Noise", ", ".join(f"{one:g}" for one in levels) if isinstance(levels, list) else levels),
        ("Level told", noise["told"]),
        ("Thinking time", "none" if terms["seconds"] is None else f"{terms['seconds']:g} s for each player and game"),
        ("Simulated shots", "any number" if terms["simulated_shots"] is None else terms["simulated_shots"]),
        ("Table", _table_of(terms["table"])),
        ("Racks and noise", "foreseeable, from a known seed" if terms["foreseeable"] else "drawn by the server"),
        ("Games played", state["played"]),
        ("State", "finished" if state["finished"] else f"under way, {state['due']} games due"),
        *([("Withdrawn", ", ".join(state["withdrawn"]))] if state["withdrawn"] else []),
    ]
    pairs = "Both games of a pair have the same racks and level, the break swapped, and noise of their own."
    if terms["simulated_shots"] is not None:
        pairs += " Agents elsewhere count their simulated shots by honour."
    return table("Terms of the event", ("Term", "Value"), rows, texts=2) + _note(pairs)


def _table_of(table: str | Mapping[str, Any]) -> str:
    """A table's name, and what is otherwise than on the named one."""
    if isinstance(table, str):
        return table
    usual = Table.named(table["name"]).to_dict()
    own = [f"{name} {text(value)}" for name, value in table.items() if value != usual.get(name)]
    return ", ".join((table["name"], *own))


def _test(data: Data) -> str:
    test, terms = data["test"], data["terms"]["sprt"]
    if test is None:
        return ""
    first, second = (one["name"] for one in data["terms"]["entrants"])
    says = {
        "open": "undecided",
        "elo0": f"accepted: at most {terms['elo0']:g} Elo",
        "elo1": f"accepted: at least {terms['elo1']:g} Elo",
    }
    rows = [
        ("Hypotheses (Elo)", f"{terms['elo0']:g} against {terms['elo1']:g}"),
        ("Error rates", f"{terms['alpha']:g} and {terms['beta']:g}"),
        ("Verdict", says[test["verdict"]]),
        ("Log-likelihood ratio", f"{test['llr']:.3f} in {test['bounds'][0]:.3f} to {test['bounds'][1]:.3f}"),
        ("Pairs looked at, in their order", test["pairs"]),
    ]
    return table(f"{first} against {second}", ("Sequential test", "Value"), rows, texts=2)


def _standings(data: Data) -> str:
    heads = ("Name", "Rank", "Points", "Score", "Games", "Won", "Drawn", "Lost", "Byes")
    ties = [one.replace("_", " ") for one in data["terms"]["tie_breaks"]]
    rows = [
        (
            one["name"] + (" (withdrawn)" if one["withdrawn"] else ""),
            *(one[key] for key in ("rank", "points", "score", "games", "wins", "draws", "losses", "byes")),
            *one["tie_breaks"],
        )
        for one in data["standings"]
    ]
    return table("The best first", (*heads, *ties), rows, says=legends.STANDINGS)


def _moments(data: Data) -> str:
    if not data.get("moments"):
        return ""
    replays = {game["record"]: game for game in data["games"]}
    cards = "".join(_moment(moment, replays[moment["record"]]) for moment in data["moments"])
    about = (
        "The strokes that changed the chance of their player to win the most, one of a game at most, by the value "
        "function of luck, which counts balls and turns and not how the balls lie."
    )
    return f'{_note(about)}<div class="moments">{cards}</div>'


def _moment(moment: Data, game: Data) -> str:
    change = f"{100 * moment['before']:.0f} % to {100 * moment['after']:.0f} %"
    told = f"{moment['player']}, stroke {moment['number']}: {change}"
    where = f" ({link(game['replay'], 'watch the game')})" if game["replay"] else ""
    return (
        f"<figure>{moment['picture']}<figcaption><strong>{text(told)}</strong> {text(moment['words'])} "
        f"{text(_name_of(game))}{where}</figcaption></figure>"
    )


_PLACE = re.compile(r"r(\d+)-m(\d+)-p(\d+)")


def _name_of(game: Data) -> str:
    """Which game it is, in words; both of a pair have the same racks, and the break is exchanged."""
    found = _PLACE.fullmatch(game["pair"])
    if found is None:
        return f"{game['pair']}, {_LEGS[game['leg']]} game"
    place, _, pair = (int(number) + 1 for number in found.groups())
    return f"Round {place}, pair {pair}, {_LEGS[game['leg']]} game"


_LEGS = ("first", "second")


def _ladder(data: Data) -> str:
    rows = [(one["name"], one["ordinal"], one["mu"], one["sigma"], one["games"]) for one in data["ladder"]]
    about = "Plackett-Luce skills that move with every game; sorted by mu - 3 sigma"
    return table(about, ("Name", "Ordinal", "mu", "sigma", "Games"), rows)


def _ratings(data: Data) -> str:
    ratings = data["ratings"]
    if not data["games"]:
        return _note("No games yet.")
    if not ratings:
        return _note("Nobody is rated by an event whose racks and noise could be foreseen.")
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
    return _figure(plot, about) + table(caption, heads, rows, says=legends.RATINGS) + _dispersion(data)


_INTERVALS = ("elo", "low", "high", "simultaneous_low", "simultaneous_high")


def _dispersion(data: Data) -> str:
    factor, check = data["dispersion"], data["bootstrap_dispersion"]
    words = f"Points of pairs vary {factor:.2f} times as much as those of two independent games without draws would."
    if check is not None:
        words += (
            f" A bootstrap over pairs, as a check, says {check:.2f}: were it far off, one factor would not do for all, "
            "and some intervals would be too narrow."
        )
    return _note(words)


def _superiority(data: Data) -> str:
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


def _cross(data: Data) -> str:
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


def _noise(data: Data) -> str:
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
    return _beside(
        _figure(plot, "Share of the points at each level, with 95 % intervals"), table("The same", heads, cells)
    )


def _fouls(data: Data) -> str:
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


def _time(data: Data) -> str:
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


def _luck(data: Data) -> str:
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
    return table("Luck a game, in points", (*heads, "from", "to"), rows, says=legends.LUCKY) + _note(about)


_LUCK = tuple((name, f"{name}_low", f"{name}_high") for name in ("score", "luck", "corrected"))


def _three(value: float | None) -> str:
    return "–" if value is None else f"{value:.3f}"


def _ends(data: Data) -> str:
    rows = [(one["reason"].replace("_", " "), one["games"]) for one in data["ends"]]
    return table("Why games ended", ("Reason", "Games"), rows)


def _games(data: Data) -> str:
    heads = ("Game", "Breaks", "Against", "Winner", "End", "Noise", "Strokes", "To watch", "Record")
    head = "".join(f'<th scope="col" class="text">{name}</th>' for name in heads)
    body = "".join(_game(game) for game in data["games"][:MOST_GAMES])
    left = len(data["games"]) - MOST_GAMES
    more = _note(f"{left} more games are in the data.") if left > 0 else ""
    return (
        '<div class="wide" tabindex="0"><table><caption>All games; those crossed out do not count. Both games of a '
        "pair have the same racks, the break exchanged.</caption>"
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>{more}"
    )


def _game(game: Data) -> str:
    players, breaker = game["players"], game["breaker"]
    winner = "–" if game["winner"] is None else players[game["winner"]]
    cells = [
        _name_of(game) + (f", again {game['attempt']}" if game["attempt"] else ""),
        players[breaker],
        players[1 - breaker],
        winner,
        game["reason"].replace("_", " ") + (" (void)" if game["void"] else ""),
        f"{game['noise']:.3g}",
        sum(game["strokes"]),
    ]
    counts = not game["void"] and game["reason"] != "aborted"
    row = "".join(f'<td class="text">{text(cell)}</td>' for cell in cells)
    watch = f'<td class="text">{link(game["replay"], "watch") if game.get("replay") else "–"}</td>'
    name = f"{game['pair']} {game['leg']}"
    record = f'<td class="text">{link(game["record"], name) if game["record"] else text(name)}</td>'
    return f"<tr{'' if counts else ' class=void'}>{row}{watch}{record}</tr>"


Sections = Sequence[tuple[str, Callable[[Data], str]]]

_SHARED: Sections = (
    ("Ratings", _ratings),
    ("Cross table", _cross),
    ("Superiority", _superiority),
    ("Score against noise", _noise),
    ("Luck", _luck),
    ("Fouls", _fouls),
    ("Time", _time),
    ("Games", _games),
)
_EVENT: Sections = (
    ("Standings", _standings),
    ("Terms", _terms),
    ("Ends of games", _ends),
    ("Turning points", _moments),
    ("Sequential test", _test),
    *_SHARED,
)
_SERVER: Sections = (("Ladder", _ladder), ("Ends of games", _ends), *_SHARED)
_NARROW = frozenset({"Terms", "Ends of games"})
"""Sections that have room beside one another."""
_HALF = ' class="half"'
