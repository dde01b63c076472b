"""What a server is told: defaults, a TOML file, the environment, the command line; each goes over the one before.

Read once, then passed to `create_app`.
"""

import hashlib
import ipaddress
import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import Field, dataclass, field, fields
from pathlib import Path
from typing import Any

from .errors import SettingsError

ENVIRONMENT_PREFIX = "POOLIAD_"
SECRET = "organiser_token"
SHORTEST_ORGANISER_TOKEN = 32
"""Characters. 32 hexadecimal digits are 128 bits, the least that no one guesses."""
FLAGS = {"true": True, "1": True, "yes": True, "false": False, "0": False, "no": False}
LOG_LEVELS = ("debug", "info", "warning", "error")
ORIGIN = re.compile(r"\*|https?://(\*\.)?[A-Za-z0-9.-]+(:[0-9]{1,5})?", re.ASCII)
"""An origin that may show the page in a frame."""
REGISTRATIONS = ("open", "invited", "closed")


def setting(default: Any, words: str, *, zero: bool = False, one_of: tuple[str, ...] = ()) -> Any:
    """A field of `Settings`.

    Args:
        default: its value unless told; its type is the setting's.
        words: what it is, for the documentation.
        zero: whether 0 is allowed, which turns it off.
        one_of: the values allowed, for a text.
    """
    return field(default=default, metadata={"words": words, "zero": zero, "one_of": one_of})


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """One server's settings; times in seconds, sizes in bytes.

    `organiser_digest` is the SHA-256 (hex) of the organiser's token, None when nobody organises; the token itself is
    never kept.
    """

    organiser_digest: str | None = None
    database: str = setting(
        "sqlite:///pooliad.db", "where everything is kept: `sqlite:///path` or `postgresql://user@host/name`"
    )
    database_seconds: float = setting(5.0, "a writer waits so long for an SQLite file that another process has locked")
    group_commit: bool = setting(
        True,
        "on SQLite, whether strokes and polls that arrive together are carried out in one transaction, with one flush",
    )
    registration: str = setting("open", "who may register agents: `open`, `invited`, `closed`", one_of=REGISTRATIONS)
    public_reads: bool = setting(True, "whether games, lists and records are read without a token")
    public_physics: bool = setting(True, "whether single shots are simulated without a token")
    token_seconds: float = setting(0.0, "how long agents' tokens are good for; 0: until revoked", zero=True)
    fetch_grace: float = setting(
        1.0, "given back of every turn for the wait until its player fetches it; 0: nothing", zero=True
    )
    fetch_grace_game: float = setting(5.0, "of that, given back at most to a player in a game; 0: nothing", zero=True)
    no_show_seconds: float = setting(60.0, "a player whose first turn nobody fetches for so long loses")
    lag_turn: float = setting(0.05, "given back of every turn for the way there and back; 0: nothing", zero=True)
    lag_game: float = setting(5.0, "given back at most to a player in a game; 0: nothing", zero=True)
    heartbeat_period: float = setting(1.0, "between signs of life: what a crash may cost a running clock at most")
    timer_period: float = setting(0.2, "between looks at the clocks")
    poll_recheck: float = setting(2.0, "between looks of a long poll that nobody woke")
    longest_wait: float = setting(60.0, "a long poll lasts at most")
    stream_recheck: float = setting(1.0, "between looks of a stream that nobody woke")
    stream_keepalive: float = setting(15.0, "between comments in a stream that is silent")
    header_seconds: float = setting(10.0, "a request's headers must be complete after")
    unread_seconds: float = setting(30.0, "an answer of which nobody reads 64 kB in so long is given up")
    held_answers: int = setting(256 * 1024 * 1024, "bytes of all answers that wait to be read at once")
    address_connections: int = setting(
        2000, "connections of one address at once; 0: any number, as behind a proxy", zero=True
    )
    body_limit: int = setting(64 * 1024, "a request's body has at most so many bytes")
    large_body_limit: int = setting(2 * 1024 * 1024, "likewise of a batch of shots, and of a tournament's terms")
    held_bodies: int = setting(
        128 * 1024 * 1024, "bytes of all bodies at once, what is beyond the first 16,384 of each"
    )
    body_seconds: float = setting(10.0, "a request's body must be complete after")
    token_rate: float = setting(200.0, "requests a second of one token; a hundred shots of a batch count as one")
    token_burst: float = setting(1000.0, "requests of one token at once")
    address_rate: float = setting(200.0, "requests a second of one address without a valid token")
    address_burst: float = setting(1000.0, "such requests at once")
    registration_rate: float = setting(0.2, "agents a second that one address registers; organisers are not counted")
    registration_burst: float = setting(100.0, "such registrations at once")
    proxies: str = setting("", "addresses or networks, apart by `,`, of proxies whose `X-Forwarded-For` is believed")
    frame_ancestors: str = setting(
        "", "pages, apart by `,`, that may show games in a frame, such as `https://example.org`; `*`: any"
    )
    streams: int = setting(64, "streams of one token, or of one address without one, that may be open at once")
    polls: int = setting(64, "long polls of one token that may be open at once")
    answer_seconds: float = setting(
        86400.0, "a stored answer is kept at least so long, and until its match is over; then its key is forgotten"
    )
    physics_threads: int = setting(2, "threads for simulations that clients ask for")
    log_level: str = setting("info", "the least that is logged: `debug`, `info`, `warning`, `error`", one_of=LOG_LEVELS)
    drain_seconds: float = setting(5.0, "the server stops at the latest so long after SIGTERM")
    house_bots: str = setting("", "agents that the server runs itself: `NAME` or `NAME=AGENT`, apart by `;`")
    house_places: int = setting(4, "matches that each of them plays at a time")
    failpoint: str = setting("", "where the server is to die, for tests of crashes (`server.failpoints`)")

    def __post_init__(self) -> None:
        _require_database(self.database)
        _networks(self.proxies)
        _origins(self.frame_ancestors)
        for each in settable():
            _check(each, getattr(self, each.name))

    @property
    def named_proxies(self) -> list[str]:
        """The addresses and networks of `proxies`, one by one."""
        return _networks(self.proxies)

    @property
    def framing_origins(self) -> list[str]:
        """The pages of `frame_ancestors`, one by one."""
        return _origins(self.frame_ancestors)

    @classmethod
    def from_environment(cls, environment: Mapping[str, str]) -> "Settings":
        """Settings from `POOLIAD_DATABASE`, `POOLIAD_ORGANISER_TOKEN`, `POOLIAD_BODY_LIMIT`, …

        Raises `SettingsError` naming the variable, its value and what is allowed.
        """
        return effective(environment=environment).settings


@dataclass(frozen=True, slots=True)
class Effective:
    """Settings, and where each comes from: `default`, `file`, `environment` or `option`."""

    settings: Settings
    sources: Mapping[str, str]

    def __str__(self) -> str:
        """The settings as a TOML file that says where they come from; secrets are masked."""
        lines = [_line(each.name, getattr(self.settings, each.name), self.sources) for each in settable()]
        token = "***" if self.settings.organiser_digest else ""
        return "\n".join([*lines, _line(SECRET, token, self.sources)])


def effective(
    config: Path | None = None, environment: Mapping[str, str] | None = None, options: Mapping[str, Any] | None = None
) -> Effective:
    """Settings from a TOML file, the environment and options of the command line (None: not given).

    Raises `SettingsError` naming what cannot be, and `OSError` when the file cannot be read.
    """
    found = {
        "file": {} if config is None else _from_file(config),
        "environment": _from_environment(environment or {}),
        "option": {name: value for name, value in (options or {}).items() if value is not None},
    }
    given: dict[str, Any] = {}
    sources: dict[str, str] = {}
    for source, values in found.items():
        given |= values
        sources |= dict.fromkeys(values, source)
    if token := given.pop(SECRET, None):
        given["organiser_digest"] = organiser_digest(token)
    return Effective(Settings(**given), sources)


def settable() -> list[Field[Any]]:
    """The fields that a file or a variable may set."""
    return [each for each in fields(Settings) if each.metadata]


def organiser_digest(token: str) -> str:
    """SHA-256 (hex) of the organiser's token; raises `SettingsError` when it is short enough to guess."""
    if len(token) < SHORTEST_ORGANISER_TOKEN:
        raise SettingsError(
            f"organiser_token = <{len(token)} characters>: must be at least {SHORTEST_ORGANISER_TOKEN} characters"
        )
    return hashlib.sha256(token.encode()).hexdigest()


def _require_database(url: str) -> None:
    is_file = url.startswith("sqlite:///") and url not in ("sqlite:///", "sqlite:///:memory:") and "?" not in url
    if not (is_file or url.startswith("postgresql://")):
        allowed = "sqlite:///path (a file) or postgresql://user@host/name"
        raise SettingsError(f"database = {without_password(url)!r}: must be {allowed}")


def _networks(text: str) -> list[str]:
    """Addresses and networks, one by one; raises `SettingsError` for what is neither."""
    named = [each.strip() for each in text.split(",") if each.strip()]
    for each in named:
        try:
            ipaddress.ip_network(each)
        except ValueError as error:
            allowed = "IP addresses and networks, such as 10.0.0.2, 10.1.0.0/16"
            raise SettingsError(f"proxies = {text!r}: must be {allowed} ({error})") from error
    return named


def _origins(text: str) -> list[str]:
    """Origins as a content security policy takes them; whatever else stood there could change the policy."""
    named = [each.strip() for each in text.split(",") if each.strip()]
    if all(ORIGIN.fullmatch(each) for each in named):
        return named
    allowed = "origins such as https://example.org or http://*.example.org:8000, apart by ',', or *"
    raise SettingsError(f"frame_ancestors = {text!r}: must be {allowed}")


def without_password(url: str) -> str:
    """A database's URL as it may be shown."""
    return re.sub(r"(//[^/@:]*:).*@", r"\1***@", url)


def _from_file(path: Path) -> dict[str, Any]:
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SettingsError(f"{path} is no TOML file: {error}") from error
    known = {each.name: type(each.default) for each in settable()} | {SECRET: str}
    for name, value in values.items():
        if name not in known:
            raise SettingsError(f"{path}: setting {name!r}: must be one of {', '.join(sorted(known))}")
        allowed = (int, float) if known[name] is float else known[name]
        if not isinstance(value, allowed) or (isinstance(value, bool) and known[name] is not bool):
            raise SettingsError(f"{path}: {name} = {value!r}: must be {_KINDS[known[name]]}")
    return {name: float(value) if known[name] is float else value for name, value in values.items()}


def _from_environment(environment: Mapping[str, str]) -> dict[str, Any]:
    given: dict[str, Any] = {}
    for each in settable():
        name = ENVIRONMENT_PREFIX + each.name.upper()
        if name in environment:
            given[each.name] = _parsed(name, environment[name], type(each.default))
    if token := environment.get(ENVIRONMENT_PREFIX + SECRET.upper()):
        given[SECRET] = token
    return given


_KINDS: Mapping[type, str] = {int: "a whole number", float: "a number", bool: "true or false", str: "a text"}


def _parsed(name: str, text: str, kind: type) -> Any:
    try:
        return FLAGS[text.lower()] if kind is bool else kind(text)
    except (ValueError, KeyError) as error:
        raise SettingsError(f"{name} = {text!r}: must be {_KINDS[kind]}") from error


def _check(each: Field[Any], value: Any) -> None:
    """Raise `SettingsError` for a value that the setting cannot have."""
    if isinstance(value, bool):
        return
    if isinstance(value, int | float):
        zero = each.metadata["zero"]
        if not (math.isfinite(value) and (value > 0 or (zero and value == 0))):
            raise SettingsError(f"{each.name} = {value!r}: must be a finite number{'' if zero else ' above 0'}")
    elif (one_of := each.metadata["one_of"]) and value not in one_of:
        raise SettingsError(f"{each.name} = {value!r}: must be one of {', '.join(one_of)}")


def _line(name: str, value: Any, sources: Mapping[str, str]) -> str:
    return f"{name} = {_shown(value)}  # {sources.get(name, 'default')}"


def _shown(value: Any) -> str:
    """A value in TOML; the password of a database's address is left out."""
    if isinstance(value, str):
        return '"' + without_password(value).replace("\\", "\\\\").replace('"', '\\"') + '"'
    return str(value).lower()
