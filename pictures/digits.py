"""The ten digits as strokes: a number on a ball needs no font, and looks the same in every program."""

from typing import Final

from pictures.elements import element

WIDTH, HEIGHT = 10.0, 16.0
"""Of the box that a digit is drawn in."""

WEIGHT = 2.7
"""Width of its strokes."""

STROKES: Final = (
    "M5 1.5C1 1.5 1 14.5 5 14.5C9 14.5 9 1.5 5 1.5Z",
    "M2.4 4.2L5.6 1.5V14.5",
    "M1.7 4.9C1.9 .5 8.3 .4 8.3 4.7C8.3 7.6 4 10.6 1.7 14.5H8.6",
    "M1.8 1.6H8.2L4.7 6.5C10 6.4 9.8 14.5 5 14.5C3.2 14.5 2 13.8 1.3 12.6",
    "M7 14.5V1.6L1.3 10.8H9.1",
    "M8.1 1.6H2.7L2.2 7.4C4.2 5.7 8.6 6 8.6 10.1C8.6 14.7 3.2 15.6 1.4 12.8",
    "M7.6 1.5C3.6 3.2 1.6 6.8 1.6 10.4C1.6 15.8 8.6 15.8 8.6 10.6C8.6 6 3 5.8 1.8 9.6",
    "M1.4 1.6H8.6L4.2 14.5",
    "M5 7.5C1.2 7.5 1.4 1.5 5 1.5C8.6 1.5 8.8 7.5 5 7.5C.3 7.5 .3 14.5 5 14.5C9.7 14.5 9.7 7.5 5 7.5Z",
    "M2.4 14.5C6.4 12.8 8.4 9.2 8.4 5.6C8.4 .2 1.4 .2 1.4 5.4C1.4 10 7 10.2 8.2 6.4",
)
"""A path for each digit, in its box."""


def written(value: int, height: float, ink: str) -> str:
    """A whole number, its middle at the origin, its digits of this height."""
    scale = height / HEIGHT
    text = str(value)
    advance = WIDTH + 1.6
    left = -0.5 * (advance * len(text) - 1.6)
    paths = "".join(
        element("path", d=STROKES[int(digit)], transform=f"translate({left + advance * place:g} {-0.5 * HEIGHT:g})")
        for place, digit in enumerate(text)
    )
    return element(
        "g",
        paths,
        transform=f"scale({scale:.3g})",
        fill="none",
        stroke=ink,
        stroke_width=WEIGHT,
        stroke_linecap="round",
        stroke_linejoin="round",
    )
