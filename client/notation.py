"""A position in one line, for command lines, logs and bug reports: `0:0.5,1.7 3:0.4,0.6`.

Ball, colon, x, comma, y in metres; balls apart by blanks, in any order. Written with as many digits as
bring the same bits back.
"""

from physics import InvalidState, TableState


def write(state: TableState) -> str:
    """The position in one line; `read` brings the same bits back."""
    return " ".join(f"{ball}:{x!r},{y!r}" for ball, (x, y) in _places(state))


def read(text: str) -> TableState:
    """The position a line describes.

    Raises:
        physics.InvalidState: not of this form, a ball named twice, or a position that cannot be.
    """
    positions: dict[str, tuple[float, float]] = {}
    for word in text.split():
        ball, place = _ball(word)
        if ball in positions:
            raise InvalidState(f"positions[{ball}]", word, "each ball may be named once")
        positions[ball] = place
    return TableState.from_dict(positions)


def _ball(word: str) -> tuple[str, tuple[float, float]]:
    """Number and place of `3:0.4,0.6`."""
    ball, _, place = word.partition(":")
    try:
        x, y = (float(number) for number in place.split(","))
    except ValueError:
        raise InvalidState("positions", word, "balls are written like 3:0.4,0.6") from None
    return ball, (x, y)


def _places(state: TableState) -> list[tuple[int, tuple[float, float]]]:
    """Ball and place of every ball on the table."""
    placed = ((ball, state.position(ball)) for ball in state.balls)
    return [(ball, place) for ball, place in placed if place is not None]
