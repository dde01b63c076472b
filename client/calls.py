"""Every request of the protocol as a value: where it goes, what it carries, how its answer is read.

Both clients send what these functions return. A request that changes something gets its `Idempotency-Key`
here, once per logical request, so that however often it is repeated the server carries it out once.
Registering an agent is the exception: its answer holds a token that the server does not keep, so it could
not be repeated.
"""

import uuid
from collections.abc import Callable
from typing import Any, Literal, TypeVar

import httpx2
from pydantic import BaseModel

from client.exchange import IDEMPOTENCY_KEY, ApiCall
from physics import Shot, Table, TableState
from protocol import (
    TURN_MESSAGE,
    AcceptRequest,
    AgentList,
    AgentToken,
    AgentView,
    BatchAnswer,
    BatchRequest,
    ClientSeedRequest,
    ClockLedger,
    DecisionRequest,
    DisqualifyRequest,
    EntriesPage,
    ForfeitRequest,
    GameAnswer,
    GameOver,
    InvitationRequest,
    Invitations,
    KeyList,
    MatchList,
    MatchOver,
    MatchRequest,
    MatchView,
    MinElevationAnswer,
    MinElevationRequest,
    SeedWanted,
    ShotParameters,
    ShotRequest,
    ShotsPage,
    SimulateAnswer,
    SimulateRequest,
    StandingsView,
    StrokeAnswer,
    TokenList,
    TokenRequest,
    TokenSecret,
    TournamentList,
    TournamentRequest,
    TournamentStatus,
    TournamentView,
    Turn,
    VoidRequest,
)
from protocol.clocks import SupervisorsReason
from protocol.matches import MatchStatus
from referee import Action, Decision

Act = Literal["start", "pause", "abort", "void", "disqualify"]
"""What an organiser does about a tournament."""

Model = TypeVar("Model", bound=BaseModel)
TurnMessage = Turn | SeedWanted | GameOver | MatchOver
"""What `turns` brings: it is your turn, a game is over, the match is over."""

NO_CONTENT = 204


def authorization(token: str | None) -> dict[str, str]:
    """The header that says who is calling."""
    return {} if token is None else {"Authorization": f"Bearer {token}"}


def register(name: str, invitation: str | None) -> ApiCall[AgentToken]:
    """Register an agent; the answer shows its token, once."""
    body = {"name": name} if invitation is None else {"name": name, "invitation": invitation}
    return ApiCall("POST", "/v1/agents", _reader(AgentToken), body=body)


def agents(cursor: str | None = None, house: bool | None = None) -> ApiCall[AgentList]:
    """One page of the registered agents; house bots alone, or all but them, when asked for."""
    params = {} if house is None else {"house": str(house).lower()}
    return ApiCall("GET", "/v1/agents", _reader(AgentList), params=_cursor(cursor) | params)


def me() -> ApiCall[AgentView]:
    """The agent whose token this is."""
    return ApiCall("GET", "/v1/agents/me", _reader(AgentView))


def rotate_token(agent: str) -> ApiCall[AgentToken]:
    """Replace an agent's token."""
    return ApiCall("POST", f"/v1/agents/{agent}/token", _reader(AgentToken), headers=_key())


def revoke_token(agent: str) -> ApiCall[None]:
    """Make an agent's token worthless."""
    return ApiCall("DELETE", f"/v1/agents/{agent}/token", _nothing, headers=_key())


def create_staff_token(request: TokenRequest) -> ApiCall[TokenSecret]:
    """Make a token for somebody who does not play; the answer shows it."""
    return ApiCall("POST", "/v1/tokens", _reader(TokenSecret), headers=_key(), body=_json(request))


def staff_tokens(cursor: str | None = None) -> ApiCall[TokenList]:
    """One page of the tokens that are not agents'."""
    return ApiCall("GET", "/v1/tokens", _reader(TokenList), params=_cursor(cursor))


def rotate_staff_token(token_id: str) -> ApiCall[TokenSecret]:
    """Replace a token under its id."""
    return ApiCall("POST", f"/v1/tokens/{token_id}/rotate", _reader(TokenSecret), headers=_key())


def revoke_staff_token(token_id: str) -> ApiCall[None]:
    """Make a token worthless."""
    return ApiCall("DELETE", f"/v1/tokens/{token_id}", _nothing, headers=_key())


def invite(request: InvitationRequest) -> ApiCall[Invitations]:
    """Make codes to register with."""
    return ApiCall("POST", "/v1/invitations", _reader(Invitations), headers=_key(), body=_json(request))


def create_match(request: MatchRequest) -> ApiCall[MatchView]:
    """Set up a match, or challenge the other agent to one."""
    return ApiCall("POST", "/v1/matches", _reader(MatchView), headers=_key(), body=_json(request))


def matches(
    cursor: str | None = None, agent: str | None = None, status: MatchStatus | None = None
) -> ApiCall[MatchList]:
    """One page of the matches, the newest first; of one agent or one status when asked for."""
    wanted = {"agent": agent, "status": status}
    params = _cursor(cursor) | {name: value for name, value in wanted.items() if value is not None}
    return ApiCall("GET", "/v1/matches", _reader(MatchList), params=params)


def match(match_id: str) -> ApiCall[MatchView]:
    """A match and how its games stand."""
    return ApiCall("GET", f"/v1/matches/{match_id}", _reader(MatchView))


def accept(match_id: str, client_seed: str | None) -> ApiCall[MatchView]:
    """Accept a challenge, adding a seed to the draw or not."""
    body = _json(AcceptRequest(client_seed=client_seed))
    return ApiCall("POST", f"/v1/matches/{match_id}/accept", _reader(MatchView), headers=_key(), body=body)


def add_seed(match_id: str, client_seed: str) -> ApiCall[MatchView]:
    """Add a seed to the draw of a match that has not begun."""
    body = _json(ClientSeedRequest(seed=client_seed))
    return ApiCall("POST", f"/v1/matches/{match_id}/seed", _reader(MatchView), headers=_key(), body=body)


def keys() -> ApiCall[KeyList]:
    """The public keys that the server signs records with."""
    return ApiCall("GET", "/v1/keys", _reader(KeyList))


def abort(match_id: str) -> ApiCall[MatchView]:
    """Stop a match."""
    return ApiCall("POST", f"/v1/matches/{match_id}/abort", _reader(MatchView), headers=_key())


def create_tournament(request: TournamentRequest) -> ApiCall[TournamentView]:
    """Make a tournament."""
    return ApiCall("POST", "/v1/tournaments", _reader(TournamentView), headers=_key(), body=_json(request))


def tournaments(cursor: str | None = None, status: TournamentStatus | None = None) -> ApiCall[TournamentList]:
    """One page of the tournaments, the newest first; of one status when asked for."""
    params = _cursor(cursor) | ({} if status is None else {"status": status})
    return ApiCall("GET", "/v1/tournaments", _reader(TournamentList), params=params)


def tournament(tournament_id: str) -> ApiCall[TournamentView]:
    """A tournament with its games."""
    return ApiCall("GET", f"/v1/tournaments/{tournament_id}", _reader(TournamentView))


def standings(tournament_id: str) -> ApiCall[StandingsView]:
    """How a tournament's entrants stand."""
    return ApiCall("GET", f"/v1/tournaments/{tournament_id}/standings", _reader(StandingsView))


def tournament_entries(tournament_id: str, cursor: int = 0) -> ApiCall[EntriesPage]:
    """One page of what was noted about a tournament, after the entry with the number ``cursor``."""
    return ApiCall(
        "GET", f"/v1/tournaments/{tournament_id}/entries", _reader(EntriesPage), params={"cursor": str(cursor)}
    )


def direct_tournament(
    tournament_id: str, act: Act, request: VoidRequest | DisqualifyRequest | None = None
) -> ApiCall[TournamentView]:
    """Start, pause or abort a tournament, take a game or an entrant out of it."""
    body = {} if request is None else {"body": _json(request)}
    return ApiCall("POST", f"/v1/tournaments/{tournament_id}/{act}", _reader(TournamentView), headers=_key(), **body)


def turns(wait: float) -> ApiCall[TurnMessage | None]:
    """Wait up to `wait` seconds for the caller's next message; None when there is none."""
    return ApiCall("GET", "/v1/turns", _turn, params={"wait": f"{wait:g}"}, poll=wait)


def play(game_id: str, version: int, action: Action, simulated: int = 0) -> ApiCall[StrokeAnswer]:
    """Answer the view with this version: a stroke, a decision or a concession; `simulated` shots are declared."""
    headers = _key() | {"If-Match": f'"{version}"'}
    if action.decision is Decision.CONCEDE:
        return ApiCall("POST", f"/v1/games/{game_id}/concede", _reader(StrokeAnswer), headers=headers)
    if action.decision is not None:
        decision = _json(DecisionRequest(decision=action.decision, simulated=simulated))
        path = f"/v1/games/{game_id}/decisions"
        return ApiCall("POST", path, _reader(StrokeAnswer), headers=headers, body=decision)
    stroke = _json(ShotRequest.of(action, simulated))
    return ApiCall("POST", f"/v1/games/{game_id}/shots", _reader(StrokeAnswer), headers=headers, body=stroke)


def forfeit(game_id: str, seat: int, reason: SupervisorsReason) -> ApiCall[GameAnswer]:
    """End a game against one of its players (organiser)."""
    request = ForfeitRequest(seat=seat, reason=reason)
    path = f"/v1/games/{game_id}/forfeit"
    return ApiCall("POST", path, _reader(GameAnswer), headers=_key(), body=_json(request))


def clock(game_id: str) -> ApiCall[ClockLedger]:
    """What the turns of a game took, and what was charged."""
    return ApiCall("GET", f"/v1/games/{game_id}/clock", _reader(ClockLedger))


def game(game_id: str) -> ApiCall[GameAnswer]:
    """A game and the caller's view of it."""
    return ApiCall("GET", f"/v1/games/{game_id}", _reader(GameAnswer))


def shots(game_id: str, cursor: int | None = None) -> ApiCall[ShotsPage]:
    """One page of a game's strokes, from `cursor` on."""
    return ApiCall("GET", f"/v1/games/{game_id}/shots", _reader(ShotsPage), params=_cursor(cursor))


def record(game_id: str) -> ApiCall[bytes]:
    """The record of a finished game, JSON lines as `pooliad replay verify` takes them."""
    return ApiCall("GET", f"/v1/games/{game_id}/record", lambda response: response.content)


def simulate(table: Table, state: TableState, shot: Shot, trace: bool, game: str | None) -> ApiCall[SimulateAnswer]:
    """One shot on the server's physics, counted against the budget of a game when one is named."""
    asked = {"shot": ShotParameters.of(shot), "trace": trace, "game": game}
    request = SimulateRequest.model_validate(_scene(table, state) | asked)
    return ApiCall("POST", "/v1/simulate", _reader(SimulateAnswer), headers=_key(), body=_json(request))


def simulate_batch(table: Table, state: TableState, shots: list[Shot], game: str | None) -> ApiCall[BatchAnswer]:
    """Many shots from one position on the server's physics, counted likewise."""
    asked = {"shots": tuple(ShotParameters.of(shot) for shot in shots), "game": game}
    request = BatchRequest.model_validate(_scene(table, state) | asked)
    return ApiCall("POST", "/v1/simulate/batch", _reader(BatchAnswer), headers=_key(), body=_json(request))


def min_elevation(table: Table, state: TableState, phi: float, a: float, b: float) -> ApiCall[MinElevationAnswer]:
    """The least elevation (deg) at which the cue is free."""
    request = MinElevationRequest.model_validate(_scene(table, state) | {"phi": phi, "a": a, "b": b})
    return ApiCall("POST", "/v1/min-elevation", _reader(MinElevationAnswer), body=_json(request), pure=True)


def _scene(table: Table, state: TableState) -> dict[str, Any]:
    """The table and the balls, as the physics endpoints take them."""
    return {"table": table.to_dict(), "balls": state.to_dict()}


def _json(request: BaseModel) -> Any:
    """A request's JSON body."""
    return request.model_dump(mode="json")


def _key() -> dict[str, str]:
    """A fresh idempotency key."""
    return {IDEMPOTENCY_KEY: str(uuid.uuid4())}


def _cursor(cursor: str | int | None) -> dict[str, str]:
    """The query that asks for the page at `cursor`."""
    return {} if cursor is None else {"cursor": str(cursor)}


def _reader(model: type[Model]) -> Callable[[httpx2.Response], Model]:
    """A function that reads a response's JSON body into `model`."""
    return lambda response: model.model_validate_json(response.content)


def _nothing(_response: httpx2.Response) -> None:
    """For answers without a body."""


def _turn(response: httpx2.Response) -> TurnMessage | None:
    """A long poll's message; None for 204."""
    return None if response.status_code == NO_CONTENT else TURN_MESSAGE.validate_json(response.content)
