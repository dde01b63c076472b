"""The asynchronous client: the same calls as `client.http`, awaited."""

import asyncio
from types import TracebackType
from typing import Self

import httpx2

from client import calls
from client.calls import TurnMessage
from client.exchange import Answer, ApiCall, Outcome, Step, Wait, exchange
from client.retry import Retry
from physics import Shot, Table, TableState
from protocol import (
    AgentList,
    AgentToken,
    AgentView,
    BatchAnswer,
    ClockLedger,
    DisqualifyRequest,
    EntriesPage,
    GameAnswer,
    InvitationRequest,
    Invitations,
    KeyList,
    MatchList,
    MatchRequest,
    MatchView,
    MinElevationAnswer,
    ShotsPage,
    SimulateAnswer,
    StandingsView,
    StrokeAnswer,
    TokenList,
    TokenRequest,
    TokenSecret,
    TournamentList,
    TournamentRequest,
    TournamentStatus,
    TournamentView,
    VoidRequest,
)
from protocol.clocks import SupervisorsReason
from protocol.matches import MatchStatus
from referee import Action


class AsyncPooliad:
    """`client.Pooliad` for asyncio: the same arguments, methods, answers and errors.

    Args:
        url: the server's address, e.g. `http://127.0.0.1:8000`.
        token: of an agent or an organiser; None for what is public.
        retry: how patient to be.
        transport: of `httpx2`, for tests and special networks.
    """

    def __init__(
        self,
        url: str,
        token: str | None = None,
        *,
        retry: Retry | None = None,
        transport: httpx2.AsyncBaseTransport | None = None,
    ) -> None:
        self._retry = retry or Retry()
        self._http = httpx2.AsyncClient(base_url=url, headers=calls.authorization(token), transport=transport)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Close the connections."""
        await self._http.aclose()

    async def register(self, name: str, *, invitation: str | None = None) -> AgentToken:
        """Register an agent; the answer holds its token, which is shown this once."""
        return await self._send(calls.register(name, invitation))

    async def agents(self, cursor: str | None = None, *, house: bool | None = None) -> AgentList:
        """One page of the registered agents; house bots alone, or all but them, when asked for."""
        return await self._send(calls.agents(cursor, house))

    async def me(self) -> AgentView:
        """The agent whose token this is."""
        return await self._send(calls.me())

    async def rotate_token(self, agent: str) -> AgentToken:
        """Replace an agent's token by a new one."""
        return await self._send(calls.rotate_token(agent))

    async def revoke_token(self, agent: str) -> None:
        """Make an agent's token worthless."""
        return await self._send(calls.revoke_token(agent))

    async def create_staff_token(self, request: TokenRequest) -> TokenSecret:
        """Make a token for an organiser, an administrator or a reader (administrator); it is shown this once."""
        return await self._send(calls.create_staff_token(request))

    async def staff_tokens(self, cursor: str | None = None) -> TokenList:
        """One page of the tokens that are not agents', without the tokens themselves (administrator)."""
        return await self._send(calls.staff_tokens(cursor))

    async def rotate_staff_token(self, token_id: str) -> TokenSecret:
        """Replace such a token by a new one under the same id (administrator)."""
        return await self._send(calls.rotate_staff_token(token_id))

    async def revoke_staff_token(self, token_id: str) -> None:
        """Make such a token worthless (administrator)."""
        return await self._send(calls.revoke_staff_token(token_id))

    async def invite(self, count: int = 1, *, seconds: float | None = None) -> Invitations:
        """Codes, each good for one registration within so many seconds (organiser)."""
        return await self._send(calls.invite(InvitationRequest(count=count, seconds=seconds)))

    async def create_match(self, request: MatchRequest) -> MatchView:
        """Set up a match (organiser), or challenge the other agent (one of the two)."""
        return await self._send(calls.create_match(request))

    async def matches(
        self, cursor: str | None = None, *, agent: str | None = None, status: MatchStatus | None = None
    ) -> MatchList:
        """One page of the matches, the newest first; of one agent (id) or one status when asked for."""
        return await self._send(calls.matches(cursor, agent, status))

    async def match(self, match_id: str) -> MatchView:
        """A match and how its games stand."""
        return await self._send(calls.match(match_id))

    async def accept(self, match_id: str, client_seed: str | None = None) -> MatchView:
        """Accept a challenge; a seed of one's own (64 hexadecimal digits) is mixed into noise and racks."""
        return await self._send(calls.accept(match_id, client_seed))

    async def add_seed(self, match_id: str, client_seed: str) -> MatchView:
        """Add a seed (64 hexadecimal digits) to the draw of a match that has not begun; once."""
        return await self._send(calls.add_seed(match_id, client_seed))

    async def keys(self) -> KeyList:
        """The public keys that the server signs records with, the newest first."""
        return await self._send(calls.keys())

    async def abort(self, match_id: str) -> MatchView:
        """Stop a match."""
        return await self._send(calls.abort(match_id))

    async def create_tournament(self, request: TournamentRequest) -> TournamentView:
        """Make a tournament; its first matches begin when it is started."""
        return await self._send(calls.create_tournament(request))

    async def tournaments(self, cursor: str | None = None, *, status: TournamentStatus | None = None) -> TournamentList:
        """One page of the tournaments, the newest first; of one status when asked for."""
        return await self._send(calls.tournaments(cursor, status))

    async def tournament(self, tournament_id: str) -> TournamentView:
        """A tournament with its games."""
        return await self._send(calls.tournament(tournament_id))

    async def standings(self, tournament_id: str) -> StandingsView:
        """How a tournament's entrants stand."""
        return await self._send(calls.standings(tournament_id))

    async def tournament_entries(self, tournament_id: str, cursor: int = 0) -> EntriesPage:
        """One page of results and decisions in their order, after the entry with the number `cursor` (organiser)."""
        return await self._send(calls.tournament_entries(tournament_id, cursor))

    async def direct_tournament(
        self, tournament_id: str, act: calls.Act, request: VoidRequest | DisqualifyRequest | None = None
    ) -> TournamentView:
        """Start (or go on after a pause), pause or abort a tournament, take a game or an entrant out of it."""
        return await self._send(calls.direct_tournament(tournament_id, act, request))

    async def turns(self, wait: float = 30.0) -> TurnMessage | None:
        """Wait up to `wait` seconds for the caller's next message; None when there is none."""
        return await self._send(calls.turns(wait))

    async def play(self, game_id: str, version: int, action: Action, *, simulated: int = 0) -> StrokeAnswer:
        """Answer the view with this version: a stroke, a decision or a concession.

        `simulated`: shots simulated elsewhere since the last action, declared against the budget of the game.
        """
        return await self._send(calls.play(game_id, version, action, simulated))

    async def forfeit(self, game_id: str, seat: int, reason: SupervisorsReason = "forfeit") -> GameAnswer:
        """End a game against the player of a seat (organiser): `crash`, `stall`, `no_show` or `forfeit`."""
        return await self._send(calls.forfeit(game_id, seat, reason))

    async def clock(self, game_id: str) -> ClockLedger:
        """What the turns of a game took, what of it was given back, and what was charged."""
        return await self._send(calls.clock(game_id))

    async def game(self, game_id: str) -> GameAnswer:
        """A game and the caller's view of it."""
        return await self._send(calls.game(game_id))

    async def shots(self, game_id: str, cursor: int | None = None) -> ShotsPage:
        """One page of a game's strokes, from `cursor` on."""
        return await self._send(calls.shots(game_id, cursor))

    async def record(self, game_id: str) -> bytes:
        """The record of a finished game: JSON lines that `pooliad replay verify` accepts."""
        return await self._send(calls.record(game_id))

    async def simulate(
        self, table: Table, state: TableState, shot: Shot, trace: bool = True, *, game: str | None = None
    ) -> SimulateAnswer:
        """One shot on the server's physics; with `game` it counts against the caller's budget in that game."""
        return await self._send(calls.simulate(table, state, shot, trace, game))

    async def simulate_batch(
        self, table: Table, state: TableState, shots: list[Shot], *, game: str | None = None
    ) -> BatchAnswer:
        """Many shots from one position on the server's physics; with `game` they count likewise."""
        return await self._send(calls.simulate_batch(table, state, shots, game))

    async def min_elevation(
        self, table: Table, state: TableState, phi: float, a: float = 0.0, b: float = 0.0
    ) -> MinElevationAnswer:
        """The least elevation (deg) at which the cue is free; None when there is none."""
        return await self._send(calls.min_elevation(table, state, phi, a, b))

    async def _send(self, call: ApiCall[Answer]) -> Answer:
        """Drive the exchange without blocking the event loop."""
        steps = exchange(call, self._retry)
        outcome: Outcome = None
        while True:
            try:
                step = steps.send(outcome)
            except StopIteration as end:
                answer: Answer = end.value
                return answer
            outcome = await self._do(step)

    async def _do(self, step: Step) -> Outcome:
        """Wait, or send a request."""
        if isinstance(step, Wait):
            await asyncio.sleep(step.seconds)
            return None
        try:
            return await self._http.request(step.method, step.path, **step.arguments())
        except httpx2.RequestError as error:
            return error
