"""Every request of the protocol as a value: where it goes, what it carries, how its answer is read.

Both clients have a method for each function with its parameters and its docstring, and send what it returns. A request
that changes something gets its `Idempotency-Key` here, once per logical request, so that however often it is repeated
the server carries it out once. Registering an agent is the exception: its answer holds a token that the server does not
keep, so it could not be repeated.
"""

import inspect
import uuid
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeVar, get_args

import httpx2
from numpy.typing import ArrayLike
from pydantic import BaseModel

import protocol as wire
from client.exchange import IDEMPOTENCY_KEY, ApiCall
from physics import Shot, Table, TableState
from physics.batch import checked_shots
from protocol.clocks import SupervisorsReason
from protocol.matches import MatchStatus
from referee import Action, Decision

Act = Literal["start", "pause", "abort", "void", "disqualify"]
"""What an organiser does about a tournament."""

Model = TypeVar("Model", bound=BaseModel)
Method = TypeVar("Method", bound=Callable[..., Any])
TurnMessage = wire.Turn | wire.SeedWanted | wire.GameOver | wire.MatchOver
"""What `turns` brings: it is your turn, a game is over, the match is over."""

NO_CONTENT = 204


def authorization(token: str | None) -> dict[str, str]:
    """The header that says who is calling."""
    return {} if token is None else {"Authorization": f"Bearer {token}"}


def as_method(method: Method, make: Callable[..., ApiCall[Any]]) -> Method:
    """Give a client's method name, docstring and signature of the call that it sends: after `self`, to its answer."""
    signature = inspect.signature(make)
    itself = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    (answer,) = get_args(signature.return_annotation)
    parameters = [itself, *signature.parameters.values()]
    method.__name__, method.__doc__ = make.__name__, make.__doc__
    vars(method)["__signature__"] = signature.replace(parameters=parameters, return_annotation=answer)
    return method


def register(name: str, *, invitation: str | None = None) -> ApiCall[wire.AgentToken]:
    """Register an agent; the answer holds its token, which is shown this once."""
    body = {"name": name} if invitation is None else {"name": name, "invitation": invitation}
    return ApiCall("POST", "/v1/agents", _reader(wire.AgentToken), body=body)


def agents(cursor: str | None = None, *, house: bool | None = None) -> ApiCall[wire.AgentList]:
    """One page of the registered agents; house bots alone, or all but them, when asked for."""
    params = {} if house is None else {"house": str(house).lower()}
    return ApiCall("GET", "/v1/agents", _reader(wire.AgentList), params=_cursor(cursor) | params)


def me() -> ApiCall[wire.AgentView]:
    """The agent whose token this is."""
    return ApiCall("GET", "/v1/agents/me", _reader(wire.AgentView))


def rotate_token(agent: str) -> ApiCall[wire.AgentToken]:
    """Replace an agent's token by a new one."""
    return ApiCall("POST", f"/v1/agents/{agent}/token", _reader(wire.AgentToken), headers=_key())


def revoke_token(agent: str) -> ApiCall[None]:
    """Make an agent's token worthless."""
    return ApiCall("DELETE", f"/v1/agents/{agent}/token", _nothing, headers=_key())


def create_staff_token(request: wire.TokenRequest) -> ApiCall[wire.TokenSecret]:
    """Make a token for an organiser, an administrator or a reader (administrator); it is shown this once."""
    return ApiCall("POST", "/v1/tokens", _reader(wire.TokenSecret), headers=_key(), body=_json(request))


def staff_tokens(cursor: str | None = None) -> ApiCall[wire.TokenList]:
    """One page of the tokens that are not agents', without the tokens themselves (administrator)."""
    return ApiCall("GET", "/v1/tokens", _reader(wire.TokenList), params=_cursor(cursor))


def rotate_staff_token(token_id: str) -> ApiCall[wire.TokenSecret]:
    """Replace such a token by a new one under the same id (administrator)."""
    return ApiCall("POST", f"/v1/tokens/{token_id}/rotate", _reader(wire.TokenSecret), headers=_key())


def revoke_staff_token(token_id: str) -> ApiCall[None]:
    """Make such a token worthless (administrator)."""
    return ApiCall("DELETE", f"/v1/tokens/{token_id}", _nothing, headers=_key())


def invite(count: int = 1, *, seconds: float | None = None) -> ApiCall[wire.Invitations]:
    """Codes, each good for one registration within so many seconds (organiser)."""
    request = wire.InvitationRequest(count=count, seconds=seconds)
    return ApiCall("POST", "/v1/invitations", _reader(wire.Invitations), headers=_key(), body=_json(request))


def create_match(request: wire.MatchRequest) -> ApiCall[wire.MatchView]:
    """Set up a match (organiser), or challenge the other agent (one of the two)."""
    return ApiCall("POST", "/v1/matches", _reader(wire.MatchView), headers=_key(), body=_json(request))


def matches(
    cursor: str | None = None, *, agent: str | None = None, status: MatchStatus | None = None
) -> ApiCall[wire.MatchList]:
    """One page of the matches, the newest first; of one agent (id) or one status when asked for."""
    wanted = {"agent": agent, "status": status}
    params = _cursor(cursor) | {name: value for name, value in wanted.items() if value is not None}
    return ApiCall("GET", "/v1/matches", _reader(wire.MatchList), params=params)


def match(match_id: str) -> ApiCall[wire.MatchView]:
    """A match and how its games stand."""
    return ApiCall("GET", f"/v1/matches/{match_id}", _reader(wire.MatchView))


def accept(match_id: str, client_seed: str | None = None) -> ApiCall[wire.MatchView]:
    """Accept a challenge; a seed of one's own (64 hexadecimal digits) is mixed into noise and racks."""
    body = _json(wire.AcceptRequest(client_seed=client_seed))
    return ApiCall("POST", f"/v1/matches/{match_id}/accept", _reader(wire.MatchView), headers=_key(), body=body)


def add_seed(match_id: str, client_seed: str) -> ApiCall[wire.MatchView]:
    """Add a seed (64 hexadecimal digits) to the draw of a match that has not begun; once."""
    body = _json(wire.ClientSeedRequest(seed=client_seed))
    return ApiCall("POST", f"/v1/matches/{match_id}/seed", _reader(wire.MatchView), headers=_key(), body=body)


def keys() -> ApiCall[wire.KeyList]:
    """The public keys that the server signs records with, the newest first."""
    return ApiCall("GET", "/v1/keys", _reader(wire.KeyList))


def abort(match_id: str) -> ApiCall[wire.MatchView]:
    """Stop a match."""
    return ApiCall("POST", f"/v1/matches/{match_id}/abort", _reader(wire.MatchView), headers=_key())


def create_tournament(request: wire.TournamentRequest) -> ApiCall[wire.TournamentView]:
    """Make a tournament; its first matches begin when it is started."""
    return ApiCall("POST", "/v1/tournaments", _reader(wire.TournamentView), headers=_key(), body=_json(request))


def tournaments(
    cursor: str | None = None, *, status: wire.TournamentStatus | None = None
) -> ApiCall[wire.TournamentList]:
    """One page of the tournaments, the newest first; of one status when asked for."""
    params = _cursor(cursor) | ({} if status is None else {"status": status})
    return ApiCall("GET", "/v1/tournaments", _reader(wire.TournamentList), params=params)


def tournament(tournament_id: str) -> ApiCall[wire.TournamentView]:
    """A tournament with its games."""
    return ApiCall("GET", f"/v1/tournaments/{tournament_id}", _reader(wire.TournamentView))


def standings(tournament_id: str) -> ApiCall[wire.StandingsView]:
    """How a tournament's entrants stand."""
    return ApiCall("GET", f"/v1/tournaments/{tournament_id}/standings", _reader(wire.StandingsView))


def tournament_entries(tournament_id: str, cursor: int = 0) -> ApiCall[wire.EntriesPage]:
    """One page of results and decisions in their order, after the entry with the number `cursor` (organiser)."""
    return ApiCall(
        "GET", f"/v1/tournaments/{tournament_id}/entries", _reader(wire.EntriesPage), params={"cursor": str(cursor)}
    )


def direct_tournament(
    tournament_id: str, act: Act, request: wire.VoidRequest | wire.DisqualifyRequest | None = None
) -> ApiCall[wire.TournamentView]:
    """Start (or go on after a pause), pause or abort a tournament, take a game or an entrant out of it."""
    body = {} if request is None else {"body": _json(request)}
    return ApiCall(
        "POST", f"/v1/tournaments/{tournament_id}/{act}", _reader(wire.TournamentView), headers=_key(), **body
    )


def turns(wait: float = 30.0) -> ApiCall[TurnMessage | None]:
    """Wait up to `wait` seconds for the caller's next message; None when there is none."""
    return ApiCall("GET", "/v1/turns", _turn, params={"wait": f"{wait:g}"}, poll=wait)


def play(game_id: str, version: int, action: Action, *, simulated: int = 0) -> ApiCall[wire.StrokeAnswer]:
    """Answer the view with this version: a stroke, a decision or a concession.

    `simulated`: shots simulated elsewhere since the last action, declared against the budget of the game.
    """
    path, body = _action(game_id, action, simulated)
    headers = _key() | {"If-Match": f'"{version}"'}
    return ApiCall("POST", path, _reader(wire.StrokeAnswer), headers=headers, body=body)


def act(game_id: str, version: int, action: Action, *, simulated: int = 0) -> ApiCall[wire.MinimalAnswer]:
    """The same as `play`, answered with the view alone: it costs server and player half as much."""
    path, body = _action(game_id, action, simulated)
    headers = _key() | {"If-Match": f'"{version}"', "Prefer": "return=minimal"}
    return ApiCall("POST", path, _reader(wire.MinimalAnswer), headers=headers, body=body)


def _action(game_id: str, action: Action, simulated: int) -> tuple[str, Any]:
    """Path and body of the request for an action."""
    if action.decision is Decision.CONCEDE:
        return f"/v1/games/{game_id}/concede", None
    if action.decision is not None:
        decision = wire.DecisionRequest(decision=action.decision, simulated=simulated)
        return f"/v1/games/{game_id}/decisions", _json(decision)
    return f"/v1/games/{game_id}/shots", _json(wire.ShotRequest.of(action, simulated))


def forfeit(game_id: str, seat: int, reason: SupervisorsReason = "forfeit") -> ApiCall[wire.GameAnswer]:
    """End a game against the player of a seat (organiser): `crash`, `stall`, `no_show` or `forfeit`."""
    request = wire.ForfeitRequest(seat=seat, reason=reason)
    path = f"/v1/games/{game_id}/forfeit"
    return ApiCall("POST", path, _reader(wire.GameAnswer), headers=_key(), body=_json(request))


def clock(game_id: str) -> ApiCall[wire.ClockLedger]:
    """What the turns of a game took, what of it was given back, and what was charged."""
    return ApiCall("GET", f"/v1/games/{game_id}/clock", _reader(wire.ClockLedger))


def game(game_id: str) -> ApiCall[wire.GameAnswer]:
    """A game and the caller's view of it."""
    return ApiCall("GET", f"/v1/games/{game_id}", _reader(wire.GameAnswer))


def shots(game_id: str, cursor: int | None = None) -> ApiCall[wire.ShotsPage]:
    """One page of a game's strokes, from `cursor` on."""
    return ApiCall("GET", f"/v1/games/{game_id}/shots", _reader(wire.ShotsPage), params=_cursor(cursor))


def record(game_id: str) -> ApiCall[bytes]:
    """The record of a finished game: JSON lines that `pooliad replay verify` accepts."""
    return ApiCall("GET", f"/v1/games/{game_id}/record", lambda response: response.content)


def simulate(
    table: Table, state: TableState, shot: Shot, trace: bool = True, *, game: str | None = None
) -> ApiCall[wire.SimulateAnswer]:
    """One shot on the server's physics; with `game` it counts against the caller's budget in that game."""
    asked = {"shot": wire.ShotParameters.of(shot), "trace": trace, "game": game}
    request = wire.SimulateRequest.model_validate(_scene(table, state) | asked)
    return ApiCall("POST", "/v1/simulate", _reader(wire.SimulateAnswer), headers=_key(), body=_json(request))


def simulate_batch(
    table: Table, state: TableState, shots: ArrayLike | Sequence[Shot], *, game: str | None = None
) -> ApiCall[wire.BatchAnswer]:
    """Many shots from one position on the server's physics; with `game` they count likewise."""
    asked = {"shots": tuple(wire.ShotParameters.of(Shot(*row)) for row in checked_shots(shots).tolist()), "game": game}
    request = wire.BatchRequest.model_validate(_scene(table, state) | asked)
    return ApiCall("POST", "/v1/simulate/batch", _reader(wire.BatchAnswer), headers=_key(), body=_json(request))


def min_elevation(
    table: Table, state: TableState, phi: float, a: float = 0.0, b: float = 0.0
) -> ApiCall[wire.MinElevationAnswer]:
    """The least elevation (deg) at which the cue is free; None when there is none."""
    request = wire.MinElevationRequest.model_validate(_scene(table, state) | {"phi": phi, "a": a, "b": b})
    return ApiCall("POST", "/v1/min-elevation", _reader(wire.MinElevationAnswer), body=_json(request), pure=True)


def ladder() -> ApiCall[wire.Ladder]:
    """The agents by rating, the highest first."""
    return ApiCall("GET", "/v1/ladder", _reader(wire.Ladder))


def tables() -> ApiCall[wire.TableList]:
    """The named tables, each with its parameters and its lines and arcs (m)."""
    return ApiCall("GET", "/v1/tables", _reader(wire.TableList))


def table(name: str) -> ApiCall[wire.TableDescription]:
    """A named table, likewise."""
    return ApiCall("GET", f"/v1/tables/{name}", _reader(wire.TableDescription))


def describe_table(table: Table) -> ApiCall[wire.TableDescription]:
    """A table with parameters of its own, likewise."""
    body = _json(wire.DescribeRequest(table=table.to_dict()))
    return ApiCall("POST", "/v1/tables", _reader(wire.TableDescription), body=body, pure=True)


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
    return None if response.status_code == NO_CONTENT else wire.TURN_MESSAGE.validate_json(response.content)
