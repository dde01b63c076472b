"""Playing an agent through the situations: a real server, a proxy that watches, an opponent that does nothing."""

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from client.adapters.stdio import LOGS
from client.arena.journal import Journal, JournalEntry
from client.cli.processes import Child
from client.cli.reports import REPORTS
from client.compliance.exchange import Exchange
from client.compliance.faults import Finding, FindingName, in_traffic
from client.compliance.proxy import Proxy
from client.compliance.situations import SITUATIONS, Situation, Twist
from client.errors import ApiError
from client.http import Pooliad
from protocol import AgentToken, ClockTerms, MatchRequest, MatchView, NoiseTerms
from referee import Action, Decision
from referee.play import MatchSeed

LOOK_EVERY = 0.05
"""Seconds between looks at what has happened."""
BRIEFLY, AFTERWARDS = 0.5, 3.0
"""Seconds an agent is watched after its action; longer where it is about a lost reply, or the end of the game."""
IN_VAIN = 3
"""Exceptions in a situation after which nothing more is expected of the agent."""
MARGIN = 15.0
"""Seconds beyond the clock within which a game must be over by itself."""
HURRY = 5.0
"""Seconds on the clock for which an agent that does not act is late rather than silent."""
SEED = "5" * 64
"""Of every match; who breaks follows from it, and the agent gets that seat."""


@dataclass(frozen=True, slots=True)
class Report:
    """What became of one situation.

    Attributes:
        situation: which. faults: what the agent did wrong in it, none when it passed.
        seconds: from the start of the match to its accepted action; None when there was none.
    """

    situation: Situation
    faults: tuple[Finding, ...]
    seconds: float | None

    def to_dict(self) -> dict[str, Any]:
        """Plain values."""
        return {
            "situation": self.situation.name,
            "ok": not self.faults,
            "faults": [fault.to_dict() for fault in self.faults],
            "seconds": self.seconds,
        }


class Checker:
    """Checks one agent.

    Args:
        server: address of a server of one's own. organiser: its organiser's token.
        command: starts the agent; it finds `POOLIAD_URL` and `POOLIAD_TOKEN` in its environment.
        directory: for the agent's log, and those of the command behind it.
    """

    def __init__(self, server: str, organiser: str, command: Sequence[str], directory: Path) -> None:
        self._server, self._token = server, organiser
        self._command, self._directory = list(command), directory
        self._child: Child | None = None
        self._journal = Journal(directory / "reports.jsonl")
        self._reported: list[JournalEntry] = []
        self._fresh = False

    def run(
        self, situations: Iterable[Situation] = SITUATIONS, on_report: Callable[[Report], Any] = lambda report: None
    ) -> list[Report]:
        """Every situation, one after the other; what was found in each. An agent that cannot be started ends it."""
        reports = []
        with Proxy(self._server) as proxy, Pooliad(self._server, self._token) as organiser:
            names = (f"opponent {time.time_ns():x}", f"checked {time.time_ns():x}")
            opponent, checked = organiser.register(names[0]), organiser.register(names[1])
            environment = {"POOLIAD_URL": proxy.url, "POOLIAD_TOKEN": checked.token, LOGS: str(self._directory)}
            environment[REPORTS] = str(self._journal.path)
            try:
                for situation in situations:
                    reports.append(self._try(situation, organiser, proxy, (opponent, checked), environment))
                    on_report(reports[-1])
                    if any(fault.name is FindingName.UNSTARTABLE for fault in reports[-1].faults):
                        break
            finally:
                if self._child is not None:
                    self._child.stop()
        return reports

    def _try(
        self,
        situation: Situation,
        organiser: Pooliad,
        proxy: Proxy,
        players: tuple[AgentToken, AgentToken],
        environment: Mapping[str, str],
    ) -> Report:
        """One match in one situation."""
        proxy.begin(situation.twist)
        self._reported = []
        self._fresh = False
        list(self._journal.new())  # what the situation before has left behind
        self._ensure_running(environment)
        started = time.monotonic()
        match = organiser.create_match(_request(situation, players))
        accepted = self._await_action(situation, organiser, proxy, match)
        if accepted is not None:
            self._finish(situation, organiser, match, players[0])
            self._watch(situation, proxy, accepted)
        self._reported.extend(self._journal.new())
        faults = [
            *in_traffic(situation, proxy.seen()),
            *_reported(situation, self._reported),
            *self._missing(situation, organiser, match, accepted, proxy),
        ]
        _call_off(organiser, match)
        if accepted is None or any(fault.name in (FindingName.LATE, FindingName.CRASHES) for fault in faults):
            self._stop()  # whatever it is still thinking about must not spill into the next situation
        return Report(situation, tuple(faults), None if accepted is None else accepted.done - started)

    def _ensure_running(self, environment: Mapping[str, str]) -> None:
        """An agent that left after its match is started anew."""
        if self._child is None or self._child.exit_code is not None:
            self._child = Child("agent", self._command, self._directory / "agent.log", environment)
            self._fresh = True

    def _stop(self) -> None:
        if self._child is not None:
            self._child.stop()
            self._child = None

    def _await_action(
        self, situation: Situation, organiser: Pooliad, proxy: Proxy, match: MatchView
    ) -> Exchange | None:
        """The first accepted action; None when the game ended without one, or the agent did."""
        end = time.monotonic() + situation.seconds + MARGIN
        while time.monotonic() < end:
            if (found := _accepted(situation, proxy.seen(), match)) is not None:
                return found
            self._reported.extend(self._journal.new())
            failing = sum(entry.kind in ("raised", "nonsense") for entry in self._reported) >= IN_VAIN
            if failing or self._crashed or organiser.match(match.id).status != "running":
                return _accepted(situation, proxy.seen(), match)
            time.sleep(LOOK_EVERY)
        return None

    @property
    def _crashed(self) -> bool:
        return self._child is not None and self._child.exit_code not in (None, 0)

    def _finish(self, situation: Situation, organiser: Pooliad, match: MatchView, opponent: AgentToken) -> None:
        """The opponent gives the game up if it is asked to and it is its turn; else the match is called off."""
        if situation.ends:
            with Pooliad(self._server, opponent.token) as player:
                view = player.game(organiser.match(match.id).played[-1].id).view
                if view.my_turn:
                    player.play(view.game, view.version, Action(decision=Decision.CONCEDE))
                    return
        _call_off(organiser, match)

    def _watch(self, situation: Situation, proxy: Proxy, accepted: Exchange) -> None:
        """See what it does now: until it has asked for its next turn a few times, or the time is over."""
        long = situation.ends or situation.twist is not Twist.NONE
        end = time.monotonic() + (AFTERWARDS if long else BRIEFLY)
        while time.monotonic() < end:
            polls = [one for one in proxy.seen() if one.path == "/v1/turns" and one.at > accepted.done]
            if len(polls) > 2 and not self._crashed:
                return
            time.sleep(LOOK_EVERY)

    def _missing(
        self, situation: Situation, organiser: Pooliad, match: MatchView, accepted: Exchange | None, proxy: Proxy
    ) -> list[Finding]:
        """What it did not do, or that it left."""
        if self._crashed:
            assert self._child is not None
            words = f"it left with exit code {self._child.exit_code}:\n{self._child.last_words()}"
            unstartable = (self._fresh and not proxy.seen()) or any(
                entry.kind == "unstartable" for entry in self._reported
            )
            return [Finding(FindingName.UNSTARTABLE if unstartable else FindingName.CRASHES, situation.name, words)]
        if accepted is not None or any(entry.kind in _REPORTED for entry in self._reported):
            return []
        outcome = organiser.match(match.id).played[-1].outcome
        name = FindingName.LATE if outcome is not None and situation.seconds <= HURRY else FindingName.SILENT
        return [Finding(name, situation.name, f"no action was accepted within {situation.seconds:g} s")]


_REPORTED = {"raised": FindingName.RAISES, "nonsense": FindingName.MALFORMED}


def _reported(situation: Situation, entries: Sequence[JournalEntry]) -> Iterator[Finding]:
    """The faults that the agent's own process has told of, each name once."""
    named = {_REPORTED[entry.kind]: entry for entry in reversed(entries) if entry.kind in _REPORTED}
    for name, entry in named.items():
        yield Finding(name, situation.name, "\n".join(filter(None, (entry.fields["words"], entry.fields["traceback"]))))


def _request(situation: Situation, players: tuple[AgentToken, AgentToken]) -> MatchRequest:
    """The match: the agent in the seat that begins."""
    opponent, checked = players[0].agent.id, players[1].agent.id
    begins = MatchSeed.from_hex(SEED).first_breaker if situation.start is None else situation.start.turn
    return MatchRequest(
        agents=(checked, opponent) if begins == 0 else (opponent, checked),
        noise=NoiseTerms(told=situation.told),
        clock=ClockTerms(seconds=situation.seconds),
        start=situation.start,
        seed=SEED,
    )


def _accepted(situation: Situation, seen: Sequence[Exchange], match: MatchView) -> Exchange | None:
    """The first action of this match that the server accepted, whether or not the agent was told."""
    games = {game.id for game in match.played}
    for one in seen:
        lost = one.status == 0 and situation.twist is Twist.LOST_REPLY
        if one.is_action and one.game in games and (one.status == 200 or lost):
            return one
    return None


def _call_off(organiser: Pooliad, match: MatchView) -> None:
    try:
        organiser.abort(match.id)
    except ApiError:
        return  # it is over already
