"""What a link to a game says of it where it is posted: title, words and picture, as Open Graph has them (ogp.me)."""

from dataclasses import dataclass
from html import escape
from importlib.util import find_spec
from typing import Final

from physics import Table
from referee.game import Outcome
from server.errors import NotFound
from server.services.play.live_game import LiveGame, find
from server.services.runtime.context import Context

WIDTH: Final = 800
"""Pixels of a picture; sites that show previews scale it down."""
DRAWS_PNG: Final = find_spec("resvg_py") is not None
"""Whether the extra `pictures` is there. Few who show previews take SVG."""


@dataclass(frozen=True, slots=True)
class Preview:
    """A game in two lines.

    Attributes:
        game: its id.
        title: who plays.
        words: how it stands.
    """

    game: str
    title: str
    words: str

    def tags(self, origin: str) -> str:
        """Elements for a page's head; `origin` is the server's address as the reader has it, without a last slash."""
        kind = "png" if DRAWS_PNG else "svg"
        values = {
            "og:site_name": "Pooliad",
            "og:type": "website",
            "og:url": f"{origin}/games/{self.game}",
            "og:title": self.title,
            "og:description": self.words,
            "og:image": f"{origin}/v1/games/{self.game}/position.{kind}",
            "og:image:type": "image/png" if DRAWS_PNG else "image/svg+xml",
            "og:image:alt": f"How the balls lie in {self.title}",
        }
        tags = [f'<meta property="{name}" content="{escape(value)}">' for name, value in values.items()]
        return "\n    ".join(["", *tags, '<meta name="twitter:card" content="summary_large_image">'])


def preview(context: Context, game_id: str) -> Preview | None:
    """A game as everybody may see it; None when there is none, or the settings show games to nobody without a token."""
    if not context.settings.public_reads:
        return None
    try:
        with context.database.reading() as connection:
            live = find(connection, game_id)
    except NotFound:
        return None
    one, other = live.fixture.players
    return Preview(live.id, f"{one} – {other}", _words(live))


def _words(live: LiveGame) -> str:
    """Which game of how many, how it stands or ended, the match's score, the table."""
    score = " : ".join(f"{points:g}" for points in live.fixture.score)
    parts = (
        f"Game {live.row.number + 1} of {live.match.games}",
        _state(live),
        f"score {score}",
        f"{Table.from_dict(live.match.table).name.replace('_', '-')} table",
    )
    return " · ".join(parts)


def _state(live: LiveGame) -> str:
    if live.is_running:
        return f"strokes so far: {live.game.stroke}"
    return "over" if live.game.outcome is None else _ending(live.game.outcome, live.fixture.players)


def _ending(outcome: Outcome, players: tuple[str, str]) -> str:
    why = outcome.reason.value.replace("_", " ")
    return f"drawn: {why}" if outcome.winner is None else f"{players[outcome.winner]} wins: {why}"
