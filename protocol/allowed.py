"""What a player may do, and where a cue ball in hand may lie."""

from typing import Self

from physics.table import Table
from protocol.tables import contact_distance
from protocol.values import Flag, Message, Number, ObjectBall, PocketNumber, trusted
from referee.game import CueBallArea, Decision, Legal


class Allowed(Message):
    """What the player whose turn it is may do.

    Attributes:
        actions: of ``shot``, ``decision``, ``concede``; empty when the game is over.
        call_required: a stroke must call a ball and a pocket, or a safety; on the break it must not.
        callable: the balls that may be called. pockets: likewise.
        safety: whether a safety may be called.
        cue_ball: where a cue ball in hand may be placed; null when it is not in hand.
        must_place: the stroke must say where, because the cue ball is not on the table.
        decisions: the choices open, when ``decision`` is among the actions.
    """

    actions: tuple[str, ...]
    call_required: Flag
    callable: tuple[ObjectBall, ...]
    pockets: tuple[PocketNumber, ...]
    safety: Flag
    cue_ball: CueBallArea | None
    must_place: Flag
    decisions: tuple[Decision, ...]

    @classmethod
    def of(cls, allowed: Legal) -> Self:
        """The wire's form of what the referee allows."""
        return trusted(
            cls,
            actions=allowed.actions,
            call_required=allowed.call_required,
            callable=allowed.callable,
            pockets=allowed.pockets,
            safety=allowed.safety,
            cue_ball=allowed.cue_ball,
            must_place=allowed.must_place,
            decisions=allowed.decisions,
        )


class Area(Message):
    """Where the cue ball may be placed: a rectangle for its centre, less the pocket mouths and other balls.

    On a table with jaws the cloth in the mouths belongs to it as well: a ball in the jaws is on the table.

    Attributes:
        name: ``kitchen`` (strictly behind the head string) or ``anywhere``.
        x, y: m, least and greatest; in the kitchen the least y itself, the head string, is not allowed.
    """

    name: CueBallArea
    x: tuple[Number, Number]
    y: tuple[Number, Number]

    @classmethod
    def of(cls, area: CueBallArea, table: Table) -> Self:
        """The rectangle of this area on this table."""
        near = contact_distance(table)
        least_y = table.head_string if area is CueBallArea.KITCHEN else near
        return trusted(cls, name=area, x=(near, table.width - near), y=(least_y, table.length - near))
