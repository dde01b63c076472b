"""What one server process is told: read once from the environment, then passed to `create_app`."""

import hashlib
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import Any

from .errors import SettingsError

ENVIRONMENT_PREFIX = "POOLIAD_"
SHORTEST_ORGANISER_TOKEN = 32
"""Characters. 32 hexadecimal digits are 128 bits, the least that no one guesses."""

MAY_BE_ZERO = frozenset({"lag_turn", "lag_game", "token_seconds"})
"""Zero turns these off; the others need a number above it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """One server's settings; times in seconds, sizes in bytes.

    `organiser_digest` is the SHA-256 (hex) of the organiser's token, None when nobody organises; the token
    itself is never kept. `fetch_grace` is how long a turn may lie unfetched before its clock starts by
    itself. `house_bots` names the agents the server runs itself, `NAME` or `NAME=AGENT`, apart by `;`;
    `house_places` is how many matches each of them plays at a time. `failpoint` is for tests of crashes
    (`server.failpoints`).
    """

    database: str = "sqlite:///pooliad.db"
    organiser_digest: str | None = None
    registration: str = "open"
    public_reads: bool = True
    token_seconds: float = 0.0
    fetch_grace: float = 5.0
    no_show_seconds: float = 60.0
    lag_turn: float = 0.05
    lag_game: float = 5.0
    heartbeat_period: float = 1.0
    timer_period: float = 0.2
    poll_recheck: float = 2.0
    longest_wait: float = 60.0
    stream_recheck: float = 1.0
    stream_keepalive: float = 15.0
    body_limit: int = 2 * 1024 * 1024
    body_seconds: float = 10.0
    drain_seconds: float = 5.0
    house_bots: str = ""
    house_places: int = 4
    failpoint: str = ""

    def __post_init__(self) -> None:
        _require_database(self.database)
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, int | float) and not (math.isfinite(value) and value >= 0):
                raise SettingsError(f"{field.name} is {value!r}; allowed: a finite number, 0 or above")
            if value == 0 and field.name not in MAY_BE_ZERO:
                raise SettingsError(f"{field.name} is {value!r}; allowed: a finite number above 0")

    @classmethod
    def from_environment(cls, environment: Mapping[str, str]) -> "Settings":
        """Settings from `POOLIAD_DATABASE`, `POOLIAD_ORGANISER_TOKEN`, `POOLIAD_BODY_LIMIT`, …

        Raises `SettingsError` naming the variable, its value and what is allowed.
        """
        given: dict[str, Any] = {}
        for field in fields(cls):
            name = ENVIRONMENT_PREFIX + field.name.upper()
            if field.name != "organiser_digest" and name in environment:
                given[field.name] = _parsed(name, environment[name], type(field.default))
        if token := environment.get(ENVIRONMENT_PREFIX + "ORGANISER_TOKEN"):
            given["organiser_digest"] = organiser_digest(token)
        return cls(**given)


def organiser_digest(token: str) -> str:
    """SHA-256 (hex) of the organiser's token; raises `SettingsError` when it is short enough to guess."""
    if len(token) < SHORTEST_ORGANISER_TOKEN:
        raise SettingsError(
            f"the organiser token has {len(token)} characters; allowed: at least {SHORTEST_ORGANISER_TOKEN}"
        )
    return hashlib.sha256(token.encode()).hexdigest()


def _require_database(url: str) -> None:
    is_file = url.startswith("sqlite:///") and url not in ("sqlite:///", "sqlite:///:memory:")
    if not (is_file or url.startswith("postgresql://")):
        allowed = "sqlite:///path (a file), postgresql://user@host/name"
        raise SettingsError(f"database is {without_password(url)!r}; allowed: {allowed}")


def without_password(url: str) -> str:
    """A database's URL as it may be shown."""
    return re.sub(r"(//[^/@]*:)[^@]*@", r"\1***@", url)


def _parsed(name: str, text: str, kind: Callable[[str], Any]) -> Any:
    try:
        return kind(text)
    except ValueError as error:
        allowed = "a whole number" if kind is int else "a number"
        raise SettingsError(f"{name} is {text!r}; allowed: {allowed}") from error
