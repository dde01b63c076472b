"""SVG elements as text."""

from html import escape

Point = tuple[float, float]


def number(value: float) -> str:
    """A number as short as a tenth of a millimetre allows."""
    text = f"{value:.1f}"
    return "0" if text in ("-0.0", "0.0") else text.removesuffix(".0")


def place(point: Point) -> str:
    """A point in a path's text."""
    return f"{number(point[0])} {number(point[1])}"


def element(name: str, *content: str, **attributes: str | float) -> str:
    """An element; ``stroke_width=2`` is written ``stroke-width="2"``."""
    written = "".join(
        f' {key.strip("_").replace("_", "-")}="{escape(value if isinstance(value, str) else number(value))}"'
        for key, value in attributes.items()
    )
    return f"<{name}{written}>{''.join(content)}</{name}>" if content else f"<{name}{written}/>"


def circle(centre: Point, radius: float, **attributes: str | float) -> str:
    """A circle."""
    return element("circle", cx=centre[0], cy=centre[1], r=radius, **attributes)


def polyline(points: list[Point]) -> str:
    """The text of a path from point to point."""
    return "M" + "L".join(place(point) for point in points)
