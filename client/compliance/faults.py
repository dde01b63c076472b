"""What an agent did wrong, by name, read off what it said in a situation."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any
from urllib.parse import parse_qsl

from client.compliance.answers import RETRY_AFTER
from client.compliance.exchange import Exchange
from client.compliance.situations import Situation, Twist

MOST_POLLS = 5
"""Empty answers in a row to polls that do not ask the server to wait; more, without a pause, is a busy loop."""
PAUSE = 0.25
"""Seconds between an empty answer and the next poll that count as a pause."""
SHOWN = 300
"""Characters of an answer that a fault repeats."""


class FindingName(StrEnum):
    """Everything that can be wrong."""

    UNSTARTABLE = "unstartable"
    RAISES = "raises"
    CRASHES = "crashes"
    SILENT = "silent"
    LATE = "late"
    MALFORMED = "malformed"
    REFUSED = "refused"
    CONCEDES = "concedes"
    NO_VERSION = "no-version"
    STALE = "stale"
    NO_KEY = "no-key"
    KEY_REUSED = "key-reused"
    NOT_YOUR_TURN = "not-your-turn"
    ACTS_AFTER_END = "acts-after-end"
    GIVES_UP = "gives-up"
    IMPATIENT = "impatient"
    HAMMERS = "hammers"


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing done wrong: its name, the situation's name, and what was seen, in words."""

    name: FindingName
    situation: str
    words: str

    def to_dict(self) -> dict[str, Any]:
        """Plain values."""
        return asdict(self) | {"name": self.name.value}


_BY_CODE = {
    "version_required": FindingName.NO_VERSION,
    "stale_version": FindingName.STALE,
    "key_reused": FindingName.KEY_REUSED,
    "not_your_turn": FindingName.NOT_YOUR_TURN,
    "game_finished": FindingName.ACTS_AFTER_END,
    "out_of_time": FindingName.LATE,
    "refused": FindingName.REFUSED,
    "invalid": FindingName.MALFORMED,
    "not_json": FindingName.MALFORMED,
    "unsupported_media_type": FindingName.MALFORMED,
    "too_large": FindingName.MALFORMED,
    "slow_body": FindingName.MALFORMED,
}


def in_traffic(situation: Situation, seen: Sequence[Exchange]) -> Iterator[Finding]:
    """The faults that the exchanges of one situation show, each name once."""
    found = {fault.name: fault for fault in reversed(list(_all(situation, seen)))}
    yield from found.values()


def _all(situation: Situation, seen: Sequence[Exchange]) -> Iterator[Finding]:
    actions = [one for one in seen if one.is_action]
    for one in actions:
        name = _named(situation, one, seen)
        if name is not None:
            yield Finding(
                name, situation.name, f"{one.path}: {one.status} {one.answer.decode(errors='replace')[:SHOWN]}"
            )
        if one.path.endswith("/concede") or b'"concede"' in one.body:
            yield Finding(FindingName.CONCEDES, situation.name, "the game is not lost")
    yield from _reactions(situation, seen, actions)
    if _is_hammering(seen):
        yield Finding(FindingName.HAMMERS, situation.name, f"over {MOST_POLLS} empty polls at once; use ?wait=30")


def _named(situation: Situation, one: Exchange, seen: Sequence[Exchange]) -> FindingName | None:
    """The fault behind a problem that the server, not the proxy, answered with."""
    if one.twisted or one.code is None:
        return None
    if one.code == "bad_header":
        return FindingName.NO_KEY if "idempotency-key" not in one.headers else FindingName.MALFORMED
    if one.code == "stale_version" and situation.twist is Twist.LOST_REPLY:
        return None  # asking again with another key is clumsy, but nothing is played twice
    if one.code == "game_finished" and not _knew_the_end(one, seen):
        return None  # the game was ended while it was thinking
    return _BY_CODE.get(one.code)


def _knew_the_end(action: Exchange, seen: Sequence[Exchange]) -> bool:
    """Whether the agent had been told before it acted that this game was over."""
    news = (one for one in seen if one.path == "/v1/turns" and one.done < action.at)
    return any(b'"game_over"' in one.answer[:40] and action.game.encode() in one.answer[:200] for one in news)


def _reactions(situation: Situation, seen: Sequence[Exchange], actions: Sequence[Exchange]) -> Iterator[Finding]:
    """What the agent did after its first action was twisted."""
    first = next((one for one in actions if one.twisted), None)
    if first is None:
        return
    later = [one for one in seen if one.at >= first.done]
    if situation.twist is Twist.LOST_REPLY and not later:
        yield Finding(FindingName.GIVES_UP, situation.name, "after a lost reply nothing more was heard of it")
    hasty = [one for one in later if one.is_action and one.at - first.done < 0.9 * RETRY_AFTER]
    if situation.twist is Twist.DRAINING and hasty:
        waited = hasty[0].at - first.done
        yield Finding(
            FindingName.IMPATIENT, situation.name, f"asked again after {waited:.2f} s; Retry-After was {RETRY_AFTER} s"
        )


def _is_hammering(seen: Sequence[Exchange]) -> bool:
    """Polls that come back empty at once, one right after the other."""
    in_a_row, last = 0, 0.0
    for one in (one for one in seen if one.path == "/v1/turns"):
        hasty = one.status == 204 and one.at - last < PAUSE and _asked_wait(one) < 1.0
        in_a_row, last = (in_a_row + 1 if hasty else 0), one.done
        if in_a_row > MOST_POLLS:
            return True
    return False


def _asked_wait(poll: Exchange) -> float:
    """Seconds that the server was asked to wait for news."""
    try:
        return float(dict(parse_qsl(poll.query)).get("wait", 0.0))
    except ValueError:
        return 0.0
