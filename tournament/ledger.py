"""An event as its entries tell it: each changes it or is refused, in the same way whenever they are read.

Whoever runs an event keeps entries, in the order in which they were decided: a file's lines, a table's rows.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from tournament.errors import InvalidResult, TournamentError
from tournament.results import GameResult
from tournament.tournament import Tournament


class LedgerEntry(Protocol):
    """What was decided: a game's result (``game``), an organiser's act, or something that changes nothing."""

    @property
    def kind(self) -> str:
        """``game``, ``void``, ``disqualify``, ``pause``, ``go_on``, ``abort``, or any other word."""

    @property
    def fields(self) -> Mapping[str, Any]:
        """``result``; ``pair`` and ``leg``; ``name``; what else there is to know."""


@dataclass(frozen=True, slots=True)
class Act:
    """An entry that is not kept yet."""

    kind: str
    fields: Mapping[str, Any]


@dataclass(frozen=True)
class Ledger:
    """How an event stands.

    Attributes:
        event: terms and results.
        begun: an organiser has had it start (whoever runs an event without one needs no such entry).
        paused: no game is to be started for now. aborted: nor ever again.
        refused: entries that could not be carried out, and why.
    """

    event: Tournament
    begun: bool = False
    paused: bool = False
    aborted: bool = False
    refused: tuple[str, ...] = field(default=())

    @property
    def state(self) -> str:
        """``finished``, ``aborted``, ``paused`` or ``running``."""
        if self.aborted:
            return "aborted"
        if self.event.finished:
            return "finished"
        return "paused" if self.paused else "running"

    @property
    def over(self) -> bool:
        """Nothing is left to be done."""
        return self.aborted or self.event.finished

    def after(self, entries: Iterable[LedgerEntry]) -> "Ledger":
        """How it stands after more entries."""
        ledger, games = self, list[GameResult]()
        for entry in entries:
            if entry.kind == "game":
                games.append(_result(entry))
                continue
            ledger, games = ledger._with(games)._changed(entry), []
        return ledger._with(games)

    def _with(self, games: list[GameResult]) -> "Ledger":
        return self.with_games(games) if games else self

    def with_games(self, results: Iterable[GameResult]) -> "Ledger":
        """With more results, one after the other: a pair of a later round may follow from results before it.

        The first one of a game stays. One that comes too late, of a game that was forfeit meanwhile or whose pair is
        no longer in the event, is passed over.
        """
        event, fresh = self.event, list[GameResult]()
        counted = set(event.games)
        seen = {(one.pair, one.leg, one.attempt) for one in event.results}
        pairs = {pair.id for pair in event.plan.pairs}
        for one in results:
            if one.pair not in pairs and fresh:
                event, fresh = event.with_results(*fresh), []
                pairs = {pair.id for pair in event.plan.pairs}
            key = one.pair, one.leg
            if one.pair in pairs and key not in counted and (*key, one.attempt) not in seen:
                fresh.append(one)
                seen.add((*key, one.attempt))
                counted |= {key} if one.counts else set()
        event = event.with_results(*fresh) if fresh else event
        return self if event is self.event else replace(self, event=event)

    def _changed(self, entry: LedgerEntry) -> "Ledger":
        act = _ACTS.get(entry.kind)
        try:
            return self if act is None else act(self, entry)
        except TournamentError as error:
            return replace(self, refused=(*self.refused, f"{entry.kind}: {error}"))


def _result(entry: LedgerEntry) -> GameResult:
    if "result" not in entry.fields:
        raise InvalidResult("game", dict(entry.fields), "must be an entry with a result")
    return GameResult.from_dict(entry.fields["result"])


def _void(ledger: Ledger, entry: LedgerEntry) -> Ledger:
    return replace(ledger, event=ledger.event.voided(entry.fields["pair"], entry.fields["leg"]))


def _disqualify(ledger: Ledger, entry: LedgerEntry) -> Ledger:
    return replace(ledger, event=ledger.event.disqualified(entry.fields["name"]))


_ACTS: dict[str, Callable[[Ledger, LedgerEntry], Ledger]] = {
    "void": _void,
    "disqualify": _disqualify,
    "pause": lambda ledger, _: replace(ledger, paused=True),
    "go_on": lambda ledger, _: replace(ledger, begun=True, paused=False),
    "abort": lambda ledger, _: replace(ledger, aborted=True),
}
"""What an organiser may do, by the kind of its entry. Other kinds (opened, incident, …) change nothing."""
