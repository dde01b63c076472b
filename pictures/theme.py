"""Colours. What they say is always said by something else too: a number, a stripe, a dash, a shape."""

from dataclasses import dataclass
from typing import Final

BLACK, IVORY = "#16161a", "#f7f4ea"

BALLS: Final = (IVORY, "#f2bd1d", "#1f4fb4", "#c92a2f", "#5f2f86", "#ea6f1c", "#0f6b47", "#7d1f2d", BLACK)
"""Of the cue ball and the solids; a stripe has the colour of the solid eight below."""

DARK_INK: Final = (0, 1, 5)
"""Solids whose number is written in black; on the others it is ivory (each at a contrast of 4.5 or more)."""


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours of a picture.

    Attributes:
        cloth, shelf: of the playing surface, and of the cloth in the mouths.
        cushion, rail, hole: of the pieces round it.
        mark: of head string, spots and sights. outline: round cushions and balls. cue_line: of the cue ball's path.
        casing: under a path of any colour, so that it stands off the cloth. call: of what was called.
    """

    cloth: str
    shelf: str
    cushion: str
    rail: str
    hole: str
    mark: str
    outline: str
    cue_line: str
    casing: str
    call: str


THEMES: Final[dict[str, Theme]] = {
    "dark": Theme(
        cloth="#1d6b52",
        shelf="#195c47",
        cushion="#124836",
        rail="#4a2c1b",
        hole="#0b0b0c",
        mark="#cfe3da",
        outline="#0a241b",
        cue_line="#ffffff",
        casing="#f4f8f5",
        call="#ffd84d",
    ),
    "light": Theme(
        cloth="#eef4f0",
        shelf="#dfe9e3",
        cushion="#b9d0c4",
        rail="#d8cbbd",
        hole="#3a3a3d",
        mark="#6f8a7e",
        outline="#2c3d35",
        cue_line="#14140f",
        casing="#2c3d35",
        call="#b34700",
    ),
}
"""By name: ``dark`` for screens, ``light`` for paper."""


def theme_of(name: str) -> Theme:
    """The theme of a name.

    Raises:
        ValueError: there is none of this name.
    """
    if not isinstance(name, str) or name not in THEMES:
        raise ValueError(f"theme = {name!r}: must be one of {tuple(THEMES)}")
    return THEMES[name]


def colour_of(ball: int) -> str:
    """The plain colour of a ball."""
    return BALLS[ball - 8 if ball > 8 else ball]


def ink_of(ball: int) -> str:
    """The colour that a ball's number is written in."""
    return BLACK if (ball - 8 if ball > 8 else ball) in DARK_INK else IVORY
