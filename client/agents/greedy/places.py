"""Where to put a cue ball in hand: straight behind a ball that a pocket awaits, or somewhere on a lattice."""

from client.geometry import Point, distance, ghost_ball, is_clear, is_free, lattice, pot
from physics import Table, TableState
from referee import CueBallArea

GAPS = (0.12, 0.3)
"""Metres from the cue ball's place to where it strikes: near is precise, further leaves room for the cue."""
COLUMNS, ROWS = 5, 3
"""Of the lattice that is tried when no ball can be shot at straight."""
BREAK_COLUMNS = 5


def straight(table: Table, state: TableState, balls: tuple[int, ...], area: CueBallArea) -> list[Point]:
    """Free places in line with a ball and a pocket, nothing in between, the most forgiving pot first."""
    kitchen = area is CueBallArea.KITCHEN
    found = [
        (pot(table, state.moved(0, place), ball, pocket).tolerance, place)
        for ball in balls
        for pocket in range(6)
        for place in _behind(table, state, ball, pocket)
        if is_free(table, state, place, kitchen)
    ]
    return [place for _, place in sorted(found, reverse=True)]


def scattered(table: Table, state: TableState, area: CueBallArea) -> list[Point]:
    """Free places all over the area."""
    return lattice(table, state, COLUMNS, ROWS, kitchen=area is CueBallArea.KITCHEN)


def roomy(table: Table, state: TableState, area: CueBallArea) -> Point:
    """The free place nearest to the table's middle, where no cushion is in the cue's way."""
    middle = 0.5 * table.width, 0.5 * table.length
    return min(scattered(table, state, area), key=lambda place: distance(place, middle))


def for_break(table: Table, state: TableState) -> list[Point]:
    """Free places just behind the head string."""
    places = lattice(table, state, BREAK_COLUMNS, 8, kitchen=True)
    return places[:BREAK_COLUMNS]


def _behind(table: Table, state: TableState, ball: int, pocket: int) -> list[Point]:
    """Places from which the pot is straight, when the way to the pocket is open."""
    lies = state.position(ball)
    mouth = float(table.mouths[pocket][0]), float(table.mouths[pocket][1])
    if lies is None or not is_clear(state, lies, mouth, table.ball_radius, ignore=(0, ball)):
        return []
    ghost = ghost_ball(lies, mouth, table.ball_radius)
    run = distance(lies, mouth)
    step = (mouth[0] - lies[0]) / run, (mouth[1] - lies[1]) / run
    return [(ghost[0] - gap * step[0], ghost[1] - gap * step[1]) for gap in GAPS]
