"""How values show themselves in a notebook: the only place of the physics that looks up to the pictures, when asked."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from physics.result import Result
    from physics.state import TableState
    from physics.table import Table


def picture(shown: "Table | TableState | Result", table: "Table | None" = None) -> str:
    """SVG of a value; ``table``: of a position."""
    from pictures import svg

    return svg(shown, table=table)
