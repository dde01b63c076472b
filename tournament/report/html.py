"""The report as one page: HTML with inline plots and style, no script, no request to anywhere."""

from collections.abc import Callable, Sequence
from importlib.resources import files

from tournament.report.blocks import text
from tournament.report.data import Data
from tournament.report.sections import course, play, strength

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"


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


Sections = Sequence[tuple[str, Callable[[Data], str]]]

_SHARED: Sections = (
    ("Ratings", strength.ratings),
    ("Cross table", strength.cross_table),
    ("Superiority", strength.superiority),
    ("Score against noise", strength.noise),
    ("Luck", play.luck),
    ("Fouls", play.fouls),
    ("Time", play.thinking_time),
    ("Games", course.games),
)
_EVENT: Sections = (
    ("Standings", course.standings),
    ("Terms", course.terms),
    ("Ends of games", course.ends),
    ("Turning points", course.moments),
    ("Sequential test", course.sequential_test),
    *_SHARED,
)
_SERVER: Sections = (("Ladder", strength.ladder), ("Ends of games", course.ends), *_SHARED)
_NARROW = frozenset({"Terms", "Ends of games"})
"""Sections that have room beside one another."""
_HALF = ' class="half"'
