"""How an event went: its terms, where everybody stands, and every game."""

import re
from collections.abc import Mapping
from typing import Any

from physics import Table
from tournament.report import legends
from tournament.report.blocks import link, note, table, text
from tournament.report.data import Data

MOST_GAMES = 2000
"""Games listed in the page; the JSON and the comma-separated values have all."""


def terms(data: Data) -> str:
    """What the entrants agreed to."""
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
    return table("Terms of the event", ("Term", "Value"), rows, texts=2) + note(pairs)


def _table_of(table: str | Mapping[str, Any]) -> str:
    """A table's name, and what is otherwise than on the named one."""
    if isinstance(table, str):
        return table
    usual = Table.named(table["name"]).to_dict()
    own = [f"{name} {text(value)}" for name, value in table.items() if value != usual.get(name)]
    return ", ".join((table["name"], *own))


def sequential_test(data: Data) -> str:
    """The sequential test: its hypotheses and its verdict; empty without one."""
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


def standings(data: Data) -> str:
    """Everybody's rank, points and tie-breaks."""
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


def moments(data: Data) -> str:
    """The strokes that turned games, each with its picture; empty where none was looked for."""
    if not data.get("moments"):
        return ""
    replays = {game["record"]: game for game in data["games"]}
    cards = "".join(_moment(moment, replays[moment["record"]]) for moment in data["moments"])
    about = (
        "The strokes that changed the chance of their player to win the most, one of a game at most, by the value "
        "function of luck, which counts balls and turns and not how the balls lie."
    )
    return f'{note(about)}<div class="moments">{cards}</div>'


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


def ends(data: Data) -> str:
    """How many games ended for which reason."""
    rows = [(one["reason"].replace("_", " "), one["games"]) for one in data["ends"]]
    return table("Why games ended", ("Reason", "Games"), rows)


def games(data: Data) -> str:
    """Every game, with links to its replay and its record."""
    heads = ("Game", "Breaks", "Against", "Winner", "End", "Noise", "Strokes", "To watch", "Record")
    head = "".join(f'<th scope="col" class="text">{name}</th>' for name in heads)
    body = "".join(_game(game) for game in data["games"][:MOST_GAMES])
    left = len(data["games"]) - MOST_GAMES
    more = note(f"{left} more games are in the data.") if left > 0 else ""
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
