"""The asynchronous client: the same calls as `client.http`, awaited."""

import asyncio
from collections.abc import Callable, Coroutine
from types import TracebackType
from typing import Any, Concatenate, ParamSpec, Self

import httpx2

from client import calls
from client.exchange import Answer, ApiCall, Outcome, Step, Wait, exchange
from client.retry import Retry

Parameters = ParamSpec("Parameters")


def _sent(
    make: Callable[Parameters, ApiCall[Answer]],
) -> Callable[Concatenate["AsyncPooliad", Parameters], Coroutine[Any, Any, Answer]]:
    """The method that sends a call of `client.calls` and returns its answer."""

    async def method(self: "AsyncPooliad", /, *args: Parameters.args, **kwargs: Parameters.kwargs) -> Answer:
        return await self._send(make(*args, **kwargs))

    return calls.as_method(method, make)


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

    register = _sent(calls.register)
    agents = _sent(calls.agents)
    me = _sent(calls.me)
    rotate_token = _sent(calls.rotate_token)
    revoke_token = _sent(calls.revoke_token)
    create_staff_token = _sent(calls.create_staff_token)
    staff_tokens = _sent(calls.staff_tokens)
    rotate_staff_token = _sent(calls.rotate_staff_token)
    revoke_staff_token = _sent(calls.revoke_staff_token)
    invite = _sent(calls.invite)
    create_match = _sent(calls.create_match)
    matches = _sent(calls.matches)
    match = _sent(calls.match)
    accept = _sent(calls.accept)
    add_seed = _sent(calls.add_seed)
    keys = _sent(calls.keys)
    abort = _sent(calls.abort)
    create_tournament = _sent(calls.create_tournament)
    tournaments = _sent(calls.tournaments)
    tournament = _sent(calls.tournament)
    standings = _sent(calls.standings)
    tournament_entries = _sent(calls.tournament_entries)
    direct_tournament = _sent(calls.direct_tournament)
    turns = _sent(calls.turns)
    play = _sent(calls.play)
    act = _sent(calls.act)
    forfeit = _sent(calls.forfeit)
    clock = _sent(calls.clock)
    game = _sent(calls.game)
    shots = _sent(calls.shots)
    record = _sent(calls.record)
    simulate = _sent(calls.simulate)
    simulate_batch = _sent(calls.simulate_batch)
    min_elevation = _sent(calls.min_elevation)
    ladder = _sent(calls.ladder)
    tables = _sent(calls.tables)
    table = _sent(calls.table)
    describe_table = _sent(calls.describe_table)

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
