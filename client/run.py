"""Play over a server until the match is over."""

import secrets
import time
from collections.abc import Callable
from typing import NoReturn

import httpx2
from pydantic import ValidationError

from client.agents.registry import Player, factory_of
from client.calls import TurnMessage
from client.errors import AgentUnstartable, BudgetSpent, Conflict, PooliadError, StaleVersion, Unprocessable
from client.http import Pooliad
from client.prepare import prepare
from client.retry import Retry
from client.session import GameSessions, log
from physics import Table
from protocol import GameOver, MatchOver, SeedWanted, Turn, View
from protocol.matches import MatchStatus
from referee.play.seeds import SEED_BYTES

POLL = 30.0
"""Seconds that one long poll may wait for a turn."""
FIRST_PAUSE, LONGEST_PAUSE = 0.05, 1.0
"""Seconds between tries of an agent that keeps failing; doubled each time, to spare server and log."""


def run_agent(
    agent: Player,
    url: str,
    token: str,
    *,
    retry: Retry | None = None,
    transport: httpx2.BaseTransport | None = None,
    match: str | None = None,
) -> MatchOver:
    """Play every turn the server offers until a match is over, and return how it ended.

    News of a match that ended before (of an agent that was started again) does not end the run while another
    match of the agent is going on.

    Args:
        agent: an `Agent` class, a function that makes an instance (called once for each game), or a name.
        url: the server's address. token: the agent's.
        retry, transport: as for `client.Pooliad`.
        match: id of the match whose end is waited for; any that was played in unless given.

    Raises:
        client.PooliadError: there is no agent of this name, it cannot be made, the token is not accepted, or the
            server stays away for longer than `retry` waits.
    """
    with Pooliad(url, token, retry=retry, transport=transport) as server:
        return TurnLoop(server, GameSessions(factory_of(agent)), match).until_over()


def serve_agent(
    agent: Player,
    url: str,
    token: str,
    *,
    retry: Retry | None = None,
    transport: httpx2.BaseTransport | None = None,
) -> NoReturn:
    """Play every turn the server offers, match after match, as house bots do. Arguments and errors as `run_agent`."""
    with Pooliad(url, token, retry=retry, transport=transport) as server:
        run = TurnLoop(server, GameSessions(factory_of(agent)))
        while True:
            run.next_message()


class TurnLoop:
    """One player at one server: turns from the server to its sessions, actions back.

    Args:
        server: a connection with the player's token.
        sessions: who plays.
        match: id of the match whose end `until_over` waits for; any that was played in unless given.
        poll: s that a long poll waits.
        pause: waits so many seconds after a bad answer.
    """

    def __init__(
        self,
        server: Pooliad,
        sessions: GameSessions,
        match: str | None = None,
        *,
        poll: float = POLL,
        pause: Callable[[float], object] = time.sleep,
    ) -> None:
        self._server = server
        self._sessions = sessions
        self._match = match
        self._poll = poll
        self._pause = pause
        self._last: View | None = None
        self._played_in: set[str] = set()
        self._failures = 0

    def until_over(self) -> MatchOver:
        """Answer messages until the one that says the match is over."""
        while True:
            message = self.next_message()
            if isinstance(message, MatchOver) and self._is_the_end(message):
                return message
            if message is None and (missed := self._missed_end()) is not None:
                return missed

    def next_message(self) -> TurnMessage | None:
        """Wait for a message, answer it if it is a turn, and return it; None when none came."""
        message = self._server.turns(self._poll)
        match message:
            case Turn(view=view):
                self._play(view)
            case SeedWanted(match=match_id):
                self._add_seed(match_id)
            case GameOver() as over:
                self._sessions.over(over)
        return message

    def _play(self, view: View) -> None:
        """Act while it is this player's turn; after a bad answer the turn is read again."""
        following: View | None = view
        while following is not None and following.my_turn:
            self._last = following
            self._played_in.add(following.match)
            following = self._answer(following)
        self._pace(failed=following is None)

    def _answer(self, view: View) -> View | None:
        """Let the player act on the view: the view that follows, or None when the game did not move on."""
        session = self._sessions.of(view)
        try:
            action = session.ask(view)
        except AgentUnstartable:
            raise
        except Exception as error:  # the session has told of it
            self._sessions.failed(view, error)
            return None
        shots = session.undeclared
        try:
            answer = self._server.act(view.game, view.version, action, simulated=shots)
        except (Unprocessable, BudgetSpent, ValidationError) as error:
            session.refused(str(error))
            self._sessions.failed(view, error)
        except (StaleVersion, Conflict) as error:
            log.warning("game %s, version %d: %s; the turn is read again", view.game, view.version, error)
        except PooliadError:
            session.doubted(shots)
            raise
        else:
            session.declared(shots)
            self._sessions.acted()
            return answer.view
        return None

    def _add_seed(self, match_id: str) -> None:
        """Add to the draw, so that the server alone cannot have chosen it; too late is no harm.

        The match begins with the seed, and with it the clock: so the physics of its table is loaded first.
        """
        try:
            prepare(Table.from_dict(self._server.match(match_id).table))
            self._server.add_seed(match_id, secrets.token_hex(SEED_BYTES))
        except Conflict as error:
            log.warning("match %s: no seed was added: %s", match_id, error)

    def _pace(self, failed: bool) -> None:
        """Pause after a failed try, longer after each."""
        self._failures = self._failures + 1 if failed else 0
        if self._failures:
            self._pause(min(LONGEST_PAUSE, FIRST_PAUSE * 2.0 ** min(self._failures - 1, 10)))

    def _is_the_end(self, over: MatchOver) -> bool:
        """Whether it is the match waited for, or one played here, or none of this agent's is left to play."""
        if self._match is not None:
            return over.match == self._match
        if over.match in self._played_in:
            return True
        agent = self._server.match(over.match).agents[over.seat]
        unfinished: tuple[MatchStatus, ...] = ("opening", "running")
        return not any(self._server.matches(agent=agent, status=status).matches for status in unfinished)

    def _missed_end(self) -> MatchOver | None:
        """The end of the match, when the message that told it was lost on its way."""
        watched = self._match or (None if self._last is None else self._last.match)
        if watched is None:
            return None
        match = self._server.match(watched)
        if match.status not in ("finished", "aborted"):
            return None
        seat = match.agents.index(self._server.me().id)
        return MatchOver(match=match.id, seat=seat, status=match.status, winner=match.winner, score=match.score)
