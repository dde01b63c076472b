"""An event as it stands: terms, results, withdrawals. Everything else is computed from these three."""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, Self

from referee.game import EndReason
from tournament.choices import Format
from tournament.errors import InvalidResult
from tournament.formats import planner
from tournament.pairings import LEGS, Bye, Due, Pair, Plan
from tournament.results import GameResult
from tournament.scores import Key, Meeting, counting, meetings
from tournament.spec import MOST_ROUNDS, Spec
from tournament.statistics.sprt import SprtState, sprt


@dataclass(frozen=True)
class Tournament:
    """An event as it stands; a value, every change gives a new one.

    Attributes:
        spec: the terms.
        results: of games, in any order, void and aborted ones among them.
        withdrawn: name to the first round in which that entrant is not paired any more. In a knockout that can be a
            round in which it has been paired: it left the meeting undecided, and the other one goes on.

    Raises:
        InvalidResult: a result is not of this event, or a game has two that count.
    """

    spec: Spec
    results: tuple[GameResult, ...] = ()
    withdrawn: Mapping[str, int] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "results", tuple(self.results))
        object.__setattr__(self, "withdrawn", MappingProxyType(dict(self.withdrawn)))
        for name, around in self.withdrawn.items():
            self._check_entrant("withdrawn", name)
            if isinstance(around, bool) or not isinstance(around, int) or not 0 <= around <= MOST_ROUNDS:
                raise InvalidResult("withdrawn", around, f"must be an integer from 0 to {MOST_ROUNDS}")
        self._check_once()

    @cached_property
    def games(self) -> dict[Key, GameResult]:
        """The result that counts for each game played, by pair id and leg."""
        return counting(self.results)

    @cached_property
    def plan(self) -> Plan:
        """The pairs and byes that are certain.

        Raises:
            InvalidResult: a result belongs to no pair of the event.
        """
        plan = planner(self.spec.format)(self.spec, self.games, self.withdrawn)
        self._check_known(self.results, {pair.id: pair for pair in plan.pairs})
        return plan

    @property
    def pairs(self) -> tuple[Pair, ...]:
        """The pairs that are certain and needed: all of the plan, or those up to the decision of the test."""
        return self.plan.pairs[: self.test.pairs] if self.test is not None and self.stopped else self.plan.pairs

    @property
    def byes(self) -> tuple[Bye, ...]:
        """Who rests in which round, as far as it is certain."""
        return self.plan.byes

    @cached_property
    def test(self) -> SprtState | None:
        """The sequential test over complete pairs in their order, up to the first one that is not; None without one."""
        if self.spec.sprt is None:
            return None
        cells = []
        for pair in self.plan.pairs:
            played = self.of_pair(pair)
            if len(played) < len(LEGS):
                break
            cells.append(round(2 * sum(game.points_of(self.spec.names[0]) for game in played)))
        return sprt(self.spec.sprt, cells)

    @property
    def stopped(self) -> bool:
        """The test has decided: no more games are needed."""
        return self.test is not None and self.test.verdict != "open"

    @cached_property
    def due(self) -> tuple[Due, ...]:
        """Games to be played now, in the order in which to start them; a game that is running is among them."""
        if self.stopped:
            return ()
        return tuple(
            Due(pair, leg, self._attempts(pair, leg))
            for pair in self.plan.pairs
            for leg in LEGS
            if (pair.id, leg) not in self.games
        )

    @property
    def finished(self) -> bool:
        """Nothing is left to be played."""
        return not self.due and (self.stopped or self.plan.complete)

    @property
    def counted(self) -> tuple[GameResult, ...]:
        """The results that standings and statistics rest on, in the order of pairs.

        Games finished after the test had decided are not among them: which ones there are depends on who was
        quicker.
        """
        return tuple(game for pair in self.pairs for game in self.of_pair(pair))

    @property
    def meetings(self) -> list[Meeting]:
        """Round by round, with what has been played."""
        return meetings(self.pairs, self.games)

    def of_pair(self, pair: Pair) -> tuple[GameResult, ...]:
        """The results of a pair that count, the first game first."""
        return tuple(self.games[pair.id, leg] for leg in LEGS if (pair.id, leg) in self.games)

    def with_results(self, *results: GameResult) -> Self:
        """The event with more results."""
        event = replace(self, results=(*self.results, *results))
        if self._all_planned() and "plan" in self.__dict__:  # it cannot change: not made again for every game
            self._check_known(results, self._pairs)
            event.__dict__["plan"], event.__dict__["_pairs"] = self.plan, self._pairs
        return event

    def voided(self, pair: str, leg: int) -> Self:
        """The event with a game's result void: the game is due again, with fresh noise.

        Raises:
            InvalidResult: the game has no result, or a later round or an extra pair has followed from it already, or
                one of its players has left the event.
        """
        result = self.games.get((pair, leg))
        if result is None:
            raise InvalidResult("pair", f"{pair} game {leg}", "must be a game with a result")
        if gone := set(self.withdrawn).intersection(result.players):
            raise InvalidResult("pair", pair, f"must be a game that can be played again: {gone.pop()} has left")
        if self._drawn_from(pair):
            raise InvalidResult("pair", pair, "must be a game that no later round or extra pair has followed from")
        void = replace(result, void=True)
        return replace(self, results=tuple(void if one is result else one for one in self.results))

    def disqualified(self, name: str) -> Self:
        """The event without an entrant: its due games are forfeit, and it is not paired any more.

        In a knockout it loses a meeting that is undecided, whatever the points are.

        Raises:
            InvalidResult: there is no such entrant.
        """
        self._check_entrant("name", name)
        lost = [due for due in self.due if name in due.pair.players]
        first = self._first_round_without(bool(lost))
        kept = lost if not self._all_planned() else [due for due in lost if due.pair.round < first]
        gone = dict(self.withdrawn) | {name: min(first, self.withdrawn.get(name, first))}
        return replace(self.with_results(*(forfeit(due, name) for due in kept)), withdrawn=gone)

    def _first_round_without(self, losing: bool) -> int:
        """The first round without an entrant who leaves now; ``losing``: in the middle of a meeting."""
        if self._all_planned():
            return self._first_free_round()
        under_way = self.plan.pairs[-1].round if self.plan.pairs else 0
        return under_way if losing and self.spec.format is Format.KNOCKOUT else under_way + 1

    def _all_planned(self) -> bool:
        """All rounds are certain from the beginning."""
        return self.spec.format in (Format.ROUND_ROBIN, Format.GAUNTLET)

    def _first_free_round(self) -> int:
        """The first round after all those in which something has been played."""
        return max((self._pairs[result.pair].round + 1 for result in self.results), default=0)

    def _drawn_from(self, pair_id: str) -> bool:
        """Whether a result exists that would not without this pair's: of a later round, of an extra pair after it."""
        if self._all_planned():
            return False
        pair, others = self._pairs[pair_id], [self._pairs[result.pair] for result in self.results]
        return any(other.round > pair.round or self._is_extra(other, pair) for other in others)

    def _is_extra(self, pair: Pair, after: Pair) -> bool:
        """Whether a pair was added to a drawn meeting of a knockout after another one of it."""
        same = (pair.round, pair.meeting) == (after.round, after.meeting)
        return same and pair.index >= self.spec.pairs and pair.index > after.index

    @cached_property
    def _pairs(self) -> dict[str, Pair]:
        """The pairs of the plan by id."""
        return {pair.id: pair for pair in self.plan.pairs}

    def _attempts(self, pair: Pair, leg: int) -> int:
        """How often a game has been played in vain."""
        return self._played[pair.id, leg]

    @cached_property
    def _played(self) -> Counter[Key]:
        return Counter((one.pair, one.leg) for one in self.results)

    def _check_entrant(self, field_: str, name: Any) -> None:
        if name not in self.spec.names:
            raise InvalidResult(field_, name, f"must be an entrant of {self.spec.name}")

    def _check_once(self) -> None:
        seen: set[Key] = set()
        for one in self.results:
            if not isinstance(one, GameResult):
                raise InvalidResult("results", one, "must be a tournament.GameResult")
            if one.counts and (one.pair, one.leg) in seen:
                raise InvalidResult(
                    "results", f"{one.pair} game {one.leg}", "must be one result that counts for each game"
                )
            if one.counts:
                seen.add((one.pair, one.leg))

    def _check_known(self, results: Iterable[GameResult], pairs: Mapping[str, Pair]) -> None:
        for result in results:
            pair = pairs.get(result.pair)
            if pair is None:
                raise InvalidResult("pair", result.pair, "must be a pair of this event")
            if result.players != pair.players or result.breaker != pair.breaker(result.leg):
                raise InvalidResult(
                    "players", (result.players, result.breaker), f"must be {pair.players}, seat {result.leg} breaking"
                )


def forfeit(due: Due, loser: str, reason: EndReason = EndReason.FORFEIT) -> GameResult:
    """The result of a game that was not played to its end because of ``loser``: R48."""
    players = due.pair.players
    winner = 1 - players.index(loser)
    return GameResult(
        due.pair.id, due.leg, players, due.breaker, winner, reason, noise=due.pair.noise, attempt=due.attempt
    )
