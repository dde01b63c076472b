"""Tables described: their parameters, and their lines and arcs for whoever draws them or aims at them. Metres."""

from itertools import product
from math import dist
from typing import Annotated, Final

from pydantic import ConfigDict, Field

from physics.pockets import Jaw, Pocket
from physics.real_table import RealTable
from physics.table import Table
from protocol.values import Digest, Flag, Integer, Message, Number, PocketNumber, Point, Request, TableValues

CushionNumber = Annotated[Integer, Field(ge=0, le=3, description="W E S N = 0..3.")]
NOSES: Final = ((2, 0, 5), (1, 5, 4), (1, 4, 3), (3, 3, 2), (0, 2, 1), (0, 1, 0))
"""The six noses, counter-clockwise from the south one: cushion, and the pockets at its two ends."""


class DescribeRequest(Request):
    """``POST /v1/tables``: a table by name or by parameters."""

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"table": "nine_foot"}, {"table": {"name": "nine_foot", "corner_mouth": 0.12}}]}
    )

    table: TableValues


class NoseView(Message):
    """A straight piece of a cushion's nose, from end to end."""

    cushion: CushionNumber
    ends: tuple[Point, Point]


class JawView(Message):
    """One jaw of a pocket: a horn, an arc, and behind it a facing, a straight line (``physics.Jaw``).

    Attributes:
        number: 0 to 11, as in ``jaw_collision``.
        tip: where nose line and facing line meet; mouths are measured between tips.
        nose_end: where the nose ends and the horn begins.
        horn_centre, horn_radius: the horn is the shorter arc about the centre from ``nose_end`` to ``facing_start``.
        facing_start, facing_end: the facing. facing_normal: unit vector from it into the mouth.
    """

    number: Annotated[Integer, Field(ge=0, le=11)]
    tip: Point
    nose_end: Point
    horn_centre: Point
    horn_radius: Number
    facing_start: Point
    facing_end: Point
    facing_normal: Point

    @classmethod
    def of(cls, jaw: Jaw) -> "JawView":
        """The wire's form of a jaw."""
        return cls.model_validate(jaw.to_dict())


class PocketView(Message):
    """One pocket (``physics.Pocket``).

    Attributes:
        number: 0 to 5. name: SW W NW NE E SE.
        mouth: its two ends: the tips of the jaws, or where a straight mouth cuts the nose lines.
        jaws: two; none where the mouth is a straight line, over which a ball drops.
        hole_centre, hole_radius: of the drop edge, a circle: a centre that reaches it is pocketed; null without jaws.
    """

    number: PocketNumber
    name: str
    mouth: tuple[Point, Point]
    jaws: tuple[JawView, ...]
    hole_centre: Point | None
    hole_radius: Number | None

    @classmethod
    def of(cls, pocket: Pocket) -> "PocketView":
        """The wire's form of a pocket."""
        return cls.model_validate(pocket.to_dict())


class TableDescription(Message):
    """A table, ready to be drawn.

    Attributes:
        table: every parameter.
        digest: SHA-256 over the parameters: names the table in commitments.
        has_jaws: whether its pockets have jaws and holes, or straight mouths.
        ball_radius: m.
        contact_distance: m, from a nose, horn or facing to the centre of a ball that touches it, seen from above.
        head_string: y, m. foot_spot: where the apex of the rack stands.
        noses: the six straight pieces, counter-clockwise from the south one.
        pockets: SW W NW NE E SE.
    """

    table: TableValues
    digest: Digest
    has_jaws: Flag
    ball_radius: Number
    contact_distance: Number
    head_string: Number
    foot_spot: Point
    noses: tuple[NoseView, ...]
    pockets: tuple[PocketView, ...]

    @classmethod
    def of(cls, table: Table) -> "TableDescription":
        """Everything there is to say about a table."""
        return cls(
            table=table.to_dict(),
            digest=table.digest,
            has_jaws=table.has_jaws,
            ball_radius=table.ball_radius,
            contact_distance=contact_distance(table),
            head_string=table.head_string,
            foot_spot=table.foot_spot,
            noses=tuple(_nose(table.pockets, *one) for one in NOSES),
            pockets=tuple(PocketView.of(pocket) for pocket in table.pockets),
        )


class TableList(Message):
    """``GET /v1/tables``: every named table."""

    tables: tuple[TableDescription, ...]


def contact_distance(table: Table) -> float:
    """m, from a nose to the centre of a ball that touches it, seen from above."""
    return table.contact_distance if isinstance(table, RealTable) else table.ball_radius


def _nose(pockets: tuple[Pocket, ...], cushion: int, first: int, second: int) -> NoseView:
    """A cushion's piece between two pockets: of their ends those on one line, and of these the nearest."""
    along = 0 if cushion < 2 else 1  # W and E are lines of one x, S and N of one y
    pairs = product(_ends(pockets[first]), _ends(pockets[second]))
    return NoseView(
        cushion=cushion, ends=min(pairs, key=lambda pair: (abs(pair[0][along] - pair[1][along]), dist(*pair)))
    )


def _ends(pocket: Pocket) -> tuple[tuple[float, float], ...]:
    """Where noses end at a pocket."""
    return tuple(jaw.nose_end for jaw in pocket.jaws) or pocket.mouth
