"""Tournaments: their terms, how they stand, and the games in them."""

from collections.abc import Mapping
from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, PlainSerializer, StringConstraints, WrapValidator
from pydantic_core import PydanticKnownError

from protocol.outcomes import OutcomeView
from protocol.standings import TournamentStatus
from protocol.values import Digest, Flag, Identifier, Integer, Message, Number, Request
from tournament.spec import Spec

EntrantName = Annotated[str, StringConstraints(min_length=1, max_length=64)]
PairId = Annotated[str, StringConstraints(pattern=r"^r[0-9]{1,4}-m[0-9]{1,6}-p[0-9]{1,6}$")]
Reason = Annotated[str, StringConstraints(max_length=500)]


def _spec(value: Any, _schema: Any) -> Spec:
    """As an event file is read: its errors name the field and what is allowed."""
    if isinstance(value, Spec):
        return value
    if not isinstance(value, Mapping):
        raise PydanticKnownError("dict_type")
    return Spec.from_dict(value)


Terms = Annotated[Spec, WrapValidator(_spec), PlainSerializer(Spec.to_dict)]
"""The terms of an event, written as in an event file."""


class TournamentRequest(Request):
    """``POST /v1/tournaments``: a new event.

    Attributes:
        terms: as in an event file (docs/running-tournaments.md): ``name``, ``entrants``, ``format``, ``pairs``, ...
            Leave the seed out: the server draws 256 bits. A chosen one is for tests: the event is marked
            ``foreseeable`` and nobody is rated by it.
        agents: entrant's name to the id of the agent that plays under it. An entrant left out is played by the
            agent of the same name.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "terms": {"name": "Cup", "entrants": ["ann", "bob"], "format": "round_robin", "pairs": 1},
                    "agents": {"ann": "a1", "bob": "a2"},
                }
            ]
        }
    )

    terms: Annotated[Terms, Field(description="The terms of the event, as in an event file.")]
    agents: Annotated[dict[EntrantName, Identifier], Field(default_factory=dict)]


class VoidRequest(Request):
    """``POST /v1/tournaments/{id}/void``: a finished game is taken out, and played again with fresh noise."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"pair": "r0-m0-p0", "leg": 0, "reason": "power cut"}]})

    pair: PairId
    leg: Annotated[Integer, Field(ge=0, le=1)]
    reason: Reason = ""


class DisqualifyRequest(Request):
    """``POST /v1/tournaments/{id}/disqualify``: an entrant leaves the event; its due games are forfeit."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"name": "bob", "reason": "left"}]})

    name: EntrantName
    reason: Reason = ""


class EntryView(Message):
    """What was decided about an event: the audit line.

    Attributes:
        kind: ``opened``, ``started``, ``pause``, ``go_on``, ``void``, ``disqualify``, ``abort``.
        by: who decided. fields: about what, and why.
    """

    at: datetime
    kind: str
    by: str
    fields: dict[str, Any]


class NumberedEntry(EntryView):
    """An entry in its place.

    Attributes:
        number: grows from entry to entry; as a ``cursor`` it leads to those that came after.
        kind: those of ``EntryView``, and ``game``: a result, in ``fields["result"]``.
    """

    number: Integer


class EntriesPage(Message):
    """``GET /v1/tournaments/{id}/entries``: results and decisions in the order in which they were noted.

    How an event stands follows from its terms, its lots and its entries alone (``tournament.ledger``).

    Attributes:
        lots: the secret that order, lots and levels come from, which tells nothing of racks and noise; null where all
            come from a chosen seed.
    """

    entries: tuple[NumberedEntry, ...]
    next_cursor: str | None = None
    lots: Digest | None = None


class TournamentGame(Message):
    """A game of an event.

    Attributes:
        pair, leg, attempt: which game; void ones keep their line. players: names, by seat.
        noise: level; null while the players are not to know it.
        match: id of the match at the server; a game that was forfeit unplayed has none.
        status: ``running``, ``finished``, ``aborted`` or ``void``.
        simulated: shots simulated at the server or declared, by seat; null while the game is running.
    """

    pair: str
    leg: Integer
    attempt: Integer
    round: Integer
    players: tuple[str, str]
    breaker: Integer
    noise: Number | None
    match: Identifier | None
    status: Literal["running", "finished", "aborted", "void"]
    outcome: OutcomeView | None
    simulated: tuple[Integer, Integer] | None


class TournamentSummary(Message):
    """An event in a list.

    Attributes:
        foreseeable: its seed was chosen, so that racks and noise can be known in advance: nobody is rated by it.
        games: counted so far; due: games that are certain and not finished.
    """

    id: Identifier
    name: str
    status: TournamentStatus
    format: str
    foreseeable: Flag
    entrants: tuple[str, ...]
    games: Integer
    due: Integer
    created_at: datetime
    started_at: datetime | None
    ended_at: datetime | None


class TournamentView(TournamentSummary):
    """An event.

    Attributes:
        terms: as ``tournament.Spec.published`` gives them, with ``foreseeable``; the seed, and levels of noise that the
            players are not told, when the event is over.
        agents: entrant's name to agent id.
        played: games that were begun, in order. log: what was decided.
    """

    terms: dict[str, Any]
    agents: dict[str, Identifier]
    played: tuple[TournamentGame, ...]
    log: tuple[EntryView, ...]


class TournamentList(Message):
    """Events, the newest first."""

    tournaments: tuple[TournamentSummary, ...]
    next_cursor: str | None = None
