"""Running an event at a server: it makes the matches; here the hosted entrants play, and the records are fetched."""

import contextlib
import json
import re
import secrets
import threading
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from client.arena.directory import EventDirectory, EventError, file_name, write_whole
from client.arena.executors import InProcess
from client.arena.hosting import Hosting, Kind
from client.arena.preflight import require_startable
from client.arena.process import ProcessSeat
from client.arena.runner import Observer
from client.arena.taken_up import LONGEST_REPORT
from client.arena.terms import Terms
from client.errors import ApiError, MatchUnfinished, NameTaken, TournamentUnfinished
from client.http import Pooliad
from client.local_game import TRIES, Lost
from client.retry import Retry
from client.run import TurnLoop
from client.session import GameSessions, Session
from protocol import GameOver, NumberedEntry, TournamentRequest, View
from referee import EndReason, Outcome, SimulationBudget
from referee.record import read_record
from tournament import GameResult, Spec, Tournament, TournamentError
from tournament.ledger import Ledger

PLACE = "server.json"
"""Which event of which server a directory is about, and the entrants' agents there."""
LOOK_EVERY = 0.5
POLL = 2.0
"""Seconds a hosted entrant's long poll waits: so long it may take to leave."""
PAUSE = 1.0
"""Seconds between tries of an entrant whose connection fails."""
GAMES = "games"
RECORD = "record"
"""Field of a journal's entry: where the server has the record, which it keeps back until the event is over."""
NUMBER = "number"
"""Field of a journal's entry that was taken over: its number at the server."""
_RECORD = re.compile(r"/v1/games/([^/]+)/record")


@dataclass(frozen=True, slots=True)
class RemoteTournament:
    """An event at a server.

    Attributes:
        url: of the server. tournament: its id. agents: entrant's name to agent id.
    """

    url: str
    tournament: str
    agents: dict[str, str]


class Stopped(Exception):
    """The runner leaves; no further turn is played."""


class RemoteRunner:
    """One event at one server, from making it, or from wherever it stands, to its end.

    Args:
        directory: where journal and records are kept.
        url: of the server. token: an organiser's.
        observer: is told how it goes.
    """

    def __init__(
        self, directory: EventDirectory, url: str, token: str, observer: Observer = lambda ledger, running: None
    ) -> None:
        self._directory = directory
        self._terms = Terms.from_dict(directory.terms())
        self._url = url
        self._token = token
        self._observer = observer
        self._journal = directory.journal
        self._ledger = Ledger(Tournament(self._terms.spec))
        self._taken = 0
        self._stop = threading.Event()

    def run(self) -> Ledger:
        """Play until the event is finished, paused or aborted.

        Raises:
            EventError: an entrant cannot be made or started, a remote one has no agent at the server; the directory is
                another server's.
            client.PooliadError: what the server does not accept.
        """
        with self._directory.alone(), Pooliad(self._url, self._token) as server:
            require_startable(self._terms, InProcess(), self._directory.logs)
            self._journal.append("begun")
            place = self._place(server)
            self._look()
            if server.tournament(place.tournament).status in ("created", "paused"):
                server.direct_tournament(place.tournament, "start")
            with self._players(server, place):
                self._watch(server, place)
        return self._ledger

    def _place(self, server: Pooliad) -> RemoteTournament:
        """The event at the server: the one that the directory is about, else a new one."""
        path = self._directory.path / PLACE
        if path.exists():
            place = RemoteTournament(**json.loads(path.read_text(encoding="utf-8")))
            if place.url != self._url:
                raise EventError(f"{self._directory.path} is an event at {place.url}, not at {self._url}")
            return place
        if self._terms.spec.lots is not None:  # of an event whose place could not be written down
            self._drawn(replace(self._terms.spec, lots=None))
        agents = {name: self._agent(server, name, hosting) for name, hosting in self._terms.hosting.items()}
        made = server.create_tournament(TournamentRequest(terms=self._terms.spec, agents=agents))
        self._drawn(replace(self._terms.spec, lots=server.tournament_entries(made.id, 0).lots))
        place = RemoteTournament(self._url, made.id, agents)
        values = {"url": place.url, "tournament": place.tournament, "agents": place.agents}
        write_whole(path, json.dumps(values, indent=2).encode())
        return place

    def _drawn(self, spec: Spec) -> None:
        """Keep what the server has drawn, in the terms: its lots when the event is made, its seed when it is over."""
        self._terms = replace(self._terms, spec=spec)
        self._directory.keep_terms(self._terms.to_dict())
        self._ledger = replace(self._ledger, event=replace(self._ledger.event, spec=spec))

    def _agent(self, server: Pooliad, name: str, hosting: Hosting) -> str:
        """The entrant's agent: the one that plays by itself, or a new one for us to play."""
        if hosting.kind is not Kind.REMOTE:
            try:
                return server.register(name).agent.id
            except NameTaken:
                return server.register(f"{name[:50]}-{secrets.token_hex(4)}").agent.id
        if hosting.remote_id is not None:
            return hosting.remote_id
        cursor = None
        while True:
            page = server.agents(cursor)
            found = [agent.id for agent in page.agents if agent.name == name]
            if found or page.next_cursor is None:
                break
            cursor = page.next_cursor
        if not found:
            raise EventError(f"entrant {name!r} is to play by itself, but no agent of this name is at {self._url}")
        return found[0]

    @contextlib.contextmanager
    def _players(self, server: Pooliad, place: RemoteTournament) -> Iterator[None]:
        """The hosted entrants at work, each with a token of its own, a thread and a process."""
        hosted = {name: each for name, each in self._terms.hosting.items() if each.kind is not Kind.REMOTE}
        tokens = {name: server.rotate_token(place.agents[name]).token for name in hosted}
        players = [_Entrant(self, name, hosted[name], tokens[name]) for name in hosted]
        threads = [threading.Thread(target=player.play) for player in players]
        for thread in threads:
            thread.start()
        try:
            yield
        finally:
            self._stop.set()
            for player in players:
                player.seat.interrupt()
            for thread in threads:
                thread.join()

    def _watch(self, server: Pooliad, place: RemoteTournament) -> None:
        """Take over results and decisions until the event rests."""
        while True:
            view = server.tournament(place.tournament)
            self._take(server, place)
            running = sum(game.status == "running" for game in view.played)
            self._observer(self._ledger, running)
            if view.status in ("finished", "aborted"):
                self._close(server, view.terms)
                return
            if view.status == "paused" and running == 0:
                return
            self._stop.wait(LOOK_EVERY)

    def _close(self, server: Pooliad, terms: dict[str, Any]) -> None:
        """Take over what the server kept back while the event went on: its seed, and records with untold noise."""
        spec = self._terms.spec
        if spec.lots is not None and spec.seed is None and "seed" in terms:
            self._drawn(replace(spec, seed=terms["seed"]))
        for entry in self._directory.journal.new():
            if record := entry.fields.get(RECORD):
                self._fetched(server, replace(GameResult.from_dict(entry.fields["result"]), record=record))

    def _take(self, server: Pooliad, place: RemoteTournament) -> None:
        """Put the server's entries that are new into the journal, one after the other as the server has them."""
        while True:
            page = server.tournament_entries(place.tournament, self._taken)
            for entry in page.entries:
                self._keep(server, entry)
            self._look()
            if page.next_cursor is None:
                return

    def _look(self) -> None:
        """Take in what the journal says that is new."""
        entries = list(self._journal.new())
        self._taken = max([self._taken, *(entry.fields.get(NUMBER, 0) for entry in entries)])
        try:
            self._ledger = self._ledger.after(entries)
        except TournamentError as error:
            raise EventError(f"{self._journal.path} does not fit the event: {error}") from None

    def _keep(self, server: Pooliad, entry: NumberedEntry) -> None:
        """Journal an entry; a game's record is put in its place first, so that a result in the journal has one.

        A record with untold noise follows when the event is over: until then the entry says where it is.
        """
        fields = entry.fields
        if entry.kind == "game":
            result = GameResult.from_dict(fields["result"])
            try:
                fields = fields | {"result": self._fetched(server, result).to_dict()}
            except (MatchUnfinished, TournamentUnfinished):
                here = replace(result, record=f"{GAMES}/{result.id}.jsonl")
                fields = fields | {"result": here.to_dict(), RECORD: result.record}
        self._journal.append(entry.kind, **{NUMBER: entry.number}, **(fields | {"by": entry.by}))

    def _fetched(self, server: Pooliad, result: GameResult) -> GameResult:
        """The result with its record in this directory; a game that was called off before it began has none."""
        if not result.record:
            return result
        found = _RECORD.fullmatch(result.record)
        if found is None:
            raise EventError(f"{result.id}: record = {result.record!r}: must be /v1/games/ID/record")
        record = server.record(found[1])
        outcome = Outcome.from_dict(read_record(record.decode().splitlines()).end["outcome"])
        if (outcome.winner, outcome.reason) != (result.winner, result.reason):
            said, told = (f"{each.reason.value} (winner: {each.winner})" for each in (outcome, result))
            raise EventError(f"{result.id} ended by {said} in its record, by {told} in the event")
        path = self._directory.games / f"{result.id}.jsonl"
        write_whole(path, record)
        return replace(result, record=f"{GAMES}/{path.name}")

    def rests(self, seconds: float = 0.0) -> bool:
        """Whether the entrants are to leave, now or within ``seconds``."""
        return self._stop.wait(seconds)

    def incident(self, name: str, what: str) -> None:
        """Note what went wrong with an entrant."""
        self._journal.append("incident", entrant=name, pair="", what=what)

    def seat(self, name: str, hosting: Hosting) -> ProcessSeat:
        """The entrant's process. At a server every hosted entrant has one: their clocks run at the same time."""
        log = self._directory.logs / f"{file_name(name)}.log"
        clocks = self._terms.spec.seconds is not None  # a match at a server always has one, else of a day
        return ProcessSeat(hosting, self._terms.agent_seed, log, lambda what: self.incident(name, what), clocks=clocks)

    def connection(self, token: str) -> Pooliad:
        """A connection with an entrant's token."""
        return Pooliad(self._url, token, retry=Retry())

    def lost(self, view: View, reason: str) -> None:
        """Tell the server that a hosted entrant's process crashed, stalled or broke the terms: it loses this game."""
        if self._stop.is_set() or view.seat is None or reason == "time_out":  # the server's clock has the last word
            return
        with Pooliad(self._url, self._token) as server, contextlib.suppress(ApiError):
            server.forfeit(view.game, view.seat, reason)  # type: ignore[arg-type]


class _Entrant(GameSessions):
    """One hosted entrant: its one process plays every game, and the journal has what it did wrong."""

    def __init__(self, runner: RemoteRunner, name: str, hosting: Hosting, token: str) -> None:
        self._runner, self._name, self._token = runner, name, token
        self.seat = runner.seat(name, hosting)
        self._game = ""
        self._bad = 0

    def play(self) -> None:
        """Play every turn until the runner stops; whatever goes wrong is noted, and tried again."""
        with contextlib.closing(self.seat), self._runner.connection(self._token) as server:
            loop = TurnLoop(server, self, poll=POLL, pause=lambda seconds: None)
            while not self._runner.rests():
                try:
                    loop.next_message()
                except Stopped:
                    return
                except Exception as error:
                    self._note(f"{type(error).__name__}: {error}")
                    self._runner.rests(PAUSE)

    def of(self, view: View) -> Session:
        """The process, in a new game if it is one."""
        if self._runner.rests():
            raise Stopped
        if view.game != self._game:
            self._game, self._bad = view.game, 0
            self.seat.begin(SimulationBudget())
        self.seat.told(view)
        return self.seat

    def over(self, message: GameOver) -> None:
        """Tell the process."""
        self.seat.over(message)

    def failed(self, view: View, error: Exception) -> None:
        """A bad answer; so many in a row as end a local game end this one too."""
        if isinstance(error, Lost):
            self._runner.lost(view, error.reason.value)
            return
        self._bad += 1
        if self._bad == 1:
            self._note(f"{view.game}: bad answer: {error}")
        if self._bad >= TRIES:
            self._runner.lost(view, EndReason.FORFEIT.value)

    def acted(self) -> None:
        """It answers well again."""
        self._bad = 0

    def _note(self, what: str) -> None:
        self._runner.incident(self._name, what[:LONGEST_REPORT])
