"""The synchronous client."""

import time
from collections.abc import Callable
from types import TracebackType
from typing import Concatenate, ParamSpec, Self

import httpx2

from client import calls
from client.exchange import Answer, ApiCall, Outcome, Step, Wait, exchange
from client.retry import Retry

Parameters = ParamSpec("Parameters")


def _sent(make: Callable[Parameters, ApiCall[Answer]]) -> Callable[Concatenate["Pooliad", Parameters], Answer]:
    """The method that sends a call of `client.calls` and returns its answer."""

    def method(self: "Pooliad", /, *args: Parameters.args, **kwargs: Parameters.kwargs) -> Answer:
        return self._send(make(*args, **kwargs))

    return calls.as_method(method, make)


class Pooliad:
    """A Pooliad server, seen by one agent, one organiser or one spectator.

    Every method is one request; it returns the parsed answer or raises a `client.PooliadError`. Requests
    that can be repeated safely are, with growing pauses (`client.Retry`).

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
        transport: httpx2.BaseTransport | None = None,
    ) -> None:
        self._retry = retry or Retry()
        self._http = httpx2.Client(base_url=url, headers=calls.authorization(token), transport=transport)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

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

    def _send(self, call: ApiCall[Answer]) -> Answer:
        """Drive the exchange with a blocking connection."""
        steps = exchange(call, self._retry)
        outcome: Outcome = None
        while True:
            try:
                step = steps.send(outcome)
            except StopIteration as end:
                answer: Answer = end.value
                return answer
            outcome = self._do(step)

    def _do(self, step: Step) -> Outcome:
        """Wait, or send a request."""
        if isinstance(step, Wait):
            time.sleep(step.seconds)
            return None
        try:
            return self._http.request(step.method, step.path, **step.arguments())
        except httpx2.RequestError as error:
            return error
