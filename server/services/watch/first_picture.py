"""What a game's page shows before its script has run: who plays, how it stands, and the table with its balls.

It stands where the script will draw the same, so that nothing moves when the canvas takes its place. What changes
without a stroke, the time on a clock, is left out and its place kept: the page keeps its `ETag` as long as the game its
version.
"""

import json
from functools import lru_cache
from html import escape
from typing import Any, Final

import pictures
from physics import Table, TableState
from pictures.theme import IVORY, colour_of
from server.services.play.live_game import find
from server.services.runtime.context import Context
from server.services.watch.page_words import ending_in_words, noise_in_words, table_in_words
from server.services.watch.spectator_events import opening

KEPT: Final = 256
"""Drawn positions that are kept: many open a game at the same time."""
EIGHT: Final = 8
CHIP: Final = 14
"""Pixels that a ball takes beside its player's name."""
UNRATED: Final = '<span class="mark" title="It counts for no rating.">unrated</span>'


def first_picture(context: Context, game_id: str) -> str:
    """The game as HTML, for the page's `main`; raises `NotFound`.

    For games that everybody may see: who asks for a page sends no token.
    """
    told, _ = opening(context, game_id, None)
    events = {event.kind: json.loads(event.data) for event in told}
    with context.database.reading() as connection:
        rated = find(connection, game_id).match.rated
    return drawn(events, rated)


def drawn(events: dict[str, Any], rated: bool) -> str:
    """The same from a stream's first events, by kind."""
    view = events["game"]["view"]
    one, other = map(escape, view["players"])
    return (
        f'<article class="game">'
        f'<header class="heading"><h1>{one} – {other}</h1>'
        f'<div class="terms">{_terms(view, events, rated)}</div></header>'
        f'<section class="scoreboard" aria-label="Players">{_side(0, view, events)}{_side(1, view, events)}'
        f'<p class="result">{_ending(view["players"], events)}</p></section>'
        f'<div class="columns"><div class="main-column"><section class="stage" aria-label="Table">'
        f'<div class="table first-picture">{_table(json.dumps(view["balls"]), json.dumps(view["table"]))}</div>'
        f"</section></div></div></article>"
    )


def _terms(view: dict[str, Any], events: dict[str, Any], rated: bool) -> str:
    facts = [
        f"<span>Game {view['number'] + 1} of {view['games']}</span>",
        f'<a href="#/matches/{escape(view["match"])}">the match</a>',
        f"<span>{escape(table_in_words(view['table']))}</span>",
        f"<span>{noise_in_words(view['noise']['level'])}</span>",
        "" if rated else UNRATED,
    ]
    if "result" in events:
        facts.append(f'<span><a href="{escape(events["result"]["record"])}" download>record</a></span>')
    return f'<span class="facts">{"".join(facts)}</span>'


def _side(seat: int, view: dict[str, Any], events: dict[str, Any]) -> str:
    """A player: score, name, what there is to do, the balls to make, whether it is there, the clock's place."""
    over = "result" in events
    score = (events["result"] if over else view)["score"][seat]
    has_turn = not over and events["clocks"]["turn"] == seat
    group = view["groups"][seat] if view["groups"] else None
    standing = ", ".join(filter(None, ("at the table" if has_turn else None, group)))
    away = not over and not events["connections"]["connected"][seat]
    return (
        f'<div class="side{" turn" if has_turn else ""}"><strong class="name">{escape(view["players"][seat])}</strong>'
        f'<span class="score" title="games won">{score:g}</span>'
        f'<span class="seat-facts">{standing}</span>'
        f'<span class="balls">{_chips(group, list(map(int, view["balls"])))}</span>'
        f'<span class="presence">{"disconnected" if away else ""}</span>'
        f"{_clock(events['clocks']['clocks'][seat])}</div>"
    )


def _chips(group: str | None, on_table: list[int]) -> str:
    """The balls of a group that are still up; the 8 when there are none."""
    if group is None:
        return ""
    own = [ball for ball in sorted(on_table) if ball not in (0, EIGHT) and (ball > EIGHT) == (group == "stripes")]
    shown = own or [ball for ball in on_table if ball == EIGHT]
    width = CHIP * max(1, len(shown))
    said = f"{len(own)} to make" if own else "the 8 to make"
    return (
        f'<svg viewBox="0 0 {width} {CHIP}" height="{CHIP}" width="{width}" role="img" aria-label="{said}">'
        f"{''.join(_chip(ball, CHIP * place + CHIP // 2) for place, ball in enumerate(shown))}</svg>"
    )


def _chip(ball: int, x: int) -> str:
    is_striped = ball > EIGHT
    outer = IVORY if is_striped else colour_of(ball)
    disc = f'<circle cx="{x}" cy="7" r="3.4" fill="{colour_of(ball)}"/>' if is_striped else ""
    return f'<circle cx="{x}" cy="7" r="5.5" fill="{outer}" class="chip"/>{disc}'


def _clock(clock: dict[str, Any]) -> str:
    """As wide as the time will be."""
    left = clock["seconds_left"]
    if left is None:
        return '<span class="clock">no clock</span>'
    digits = len(str(int(max(0.0, left) // 60)))
    return f'<span class="clock to-come" aria-hidden="true">{"0" * digits}:00</span>'


def _ending(players: list[str], events: dict[str, Any]) -> str:
    outcome = events.get("result", {}).get("outcome")
    return escape(ending_in_words(outcome, players)) if outcome else ""


@lru_cache(KEPT)
def _table(balls: str, table: str) -> str:
    """The balls as they lie, once lying and once upright: the style sheet shows the one that is larger."""
    state, shape = TableState.from_dict(json.loads(balls)), Table.from_dict(json.loads(table))
    return "".join(
        pictures.svg(state, table=shape, upright=upright, title="How the balls lie").replace(
            "<svg ", f'<svg class="{"upright" if upright else "lying"}" ', 1
        )
        for upright in (False, True)
    )
