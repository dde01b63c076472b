"""Tables described: what they are made of, and their lines and arcs for whoever draws them."""

from fastapi import APIRouter

from physics import Table
from physics.table import NAMED
from protocol import DescribeRequest, TableDescription, TableList, shown
from server.errors import NotFound, Unauthorized
from server.http.commands import parse_body
from server.http.dependencies import ANYBODY, Body, ContentType
from server.http.describe import describe

router = APIRouter(prefix="/v1/tables", tags=["physics"], dependencies=[ANYBODY])


@router.get("", **describe(Unauthorized, token=False), summary="The named tables")
def listing() -> TableList:
    """Those that a match, an event or a simulation can name."""
    return TableList(tables=tuple(TableDescription.of(Table.named(name)) for name in NAMED))


@router.get("/{name}", **describe(Unauthorized, NotFound, token=False), summary="One named table")
def one(name: str) -> TableDescription:
    """Its parameters; noses, horns, facings and holes in metres."""
    if name not in NAMED:
        raise NotFound(
            f"there is no table {shown(name)!r}: must be one of {', '.join(NAMED)}",
            field="name",
            value=shown(name),
            allowed=f"one of {', '.join(NAMED)}",
        )
    return TableDescription.of(Table.named(name))


@router.post(
    "",
    **describe(Unauthorized, body=DescribeRequest, success={200: TableDescription}, token=False),
    summary="A table given by its parameters",
)
def described(body: Body, content_type: ContentType = None) -> TableDescription:
    """The same of a table with parameters of its own. Nothing is stored."""
    return TableDescription.of(Table.from_dict(parse_body(body, content_type, DescribeRequest).table))
