"""A server's services over a real database file, at a time that moves when it is told to."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from protocol import AgentRequest
from server.errors import Refused
from server.http.commands import Command
from server.security.callers import ORGANISER, Caller
from server.services.accounts import agents
from server.services.matches import matches
from server.services.play import history, strokes, turns
from server.services.play.clock.flag import flag
from server.services.runtime.context import Context
from server.services.runtime.time import TimeSource
from server.settings import Settings
from server.store.database import Database
from server.store.upgrade import upgrade

SECOND = 1_000_000_000
TERMS = {"clock": {"seconds": 10.0}}


class StoppedTime(TimeSource):
    """A time that moves when it is told to, in nanoseconds."""

    def __init__(self) -> None:
        super().__init__()
        self.value = 1_000 * SECOND

    def now(self) -> int:
        return self.value

    def adjust(self) -> None:
        """There is no other clock to follow."""

    def pass_(self, seconds: float) -> None:
        self.value += round(seconds * SECOND)


class Stage:
    """A database, its context, and the games played on it; closed at the end."""

    def __init__(self, path: Path, **settings: Any) -> None:
        self.time = StoppedTime()
        made = Settings(**settings)
        database = Database(f"sqlite:///{path}", group_commit=made.group_commit)
        upgrade(database)
        self.context = Context(made, database, time=self.time)

    def close(self) -> None:
        self.context.database.dispose()

    def meanwhile(self, point: str, act: Callable[[], object]) -> list[str]:
        """Do something, once, when a stroke comes to a failpoint; the points come to from now on."""
        reached: list[str] = []

        def reach(name: str) -> None:
            reached.append(name)
            if reached.count(point) == 1 and name == point:
                act()

        object.__setattr__(self.context, "failpoint", reach)
        return reached

    def game(self, *names: str, **terms: Any) -> "Seats":
        """A running game between two new agents."""
        registered = [agents.register(self.context, AgentRequest(name=name)) for name in names]
        ids = [json.loads(answer.body)["agent"]["id"] for answer in registered]
        body = json.dumps({"agents": ids} | TERMS | terms).encode()
        match = json.loads(matches.create(self.context, self.command(ORGANISER, body, key=names[0])).body)
        return Seats(self, match["played"][0]["id"], ids, match["first_breaker"])

    def command(self, caller: str, body: bytes = b"", key: str = "k", version: int | None = None) -> Command:
        """A complete request that arrives now."""
        if_match = None if version is None else f'"{version}"'
        who = Caller.organiser("t") if caller == ORGANISER else Caller(caller, "t")
        return Command(who, "/route", key, if_match, "application/json", body, self.time.now())

    def waiting(self, seats: "Seats") -> int | None:
        """The seat whose turn it is in a game; None when it is over."""
        answer = json.loads(history.game(self.context, seats.id, None).body)
        return None if answer["view"]["turn"] is None else int(answer["view"]["turn"])

    def fetched(self, seats: "Seats", seat: int) -> dict[str, Any]:
        """The turn that a seat fetches."""
        message = self.news(seats.ids[seat])
        assert message is not None
        assert message["type"] == "turn"
        return dict(message["view"])

    def act(self, seats: "Seats", view: dict[str, Any], action: dict[str, Any]) -> None:
        """Whoever has this view plays, or concedes where the referee refuses."""
        key, version = f"a{view['version']}", view["version"]
        command = self.command(seats.ids[view["seat"]], json.dumps(action).encode(), key, version)
        act = strokes.decide if "decision" in action else strokes.shoot
        try:
            act(self.context, seats.id, lambda _: command)
        except Refused:
            strokes.concede(self.context, seats.id, lambda _: command)

    def news(self, agent: str) -> dict[str, Any] | None:
        """What the agent is told next, after the timer has looked."""
        flag(self.context)
        message = next_message(self.context, agent)
        return None if message is None else json.loads(message)


def next_message(context: Context, agent: str) -> bytes | None:
    """What an agent fetches without waiting."""
    asker = turns.Asker(Caller(agent, "t"), agent, 0.0)
    return turns.Fetch(context, lambda connection: asker).carried_out()[1]


class Seats:
    """One game and its players."""

    def __init__(self, stage: Stage, game: str, ids: list[str], breaker: int) -> None:
        self.stage, self.id, self.ids, self.breaker = stage, game, ids, breaker

    @property
    def mover(self) -> str:
        """Whose the break is."""
        return self.ids[self.breaker]

    def fetch(self) -> dict[str, Any]:
        """The breaker fetches the turn."""
        message = self.stage.news(self.mover)
        assert message is not None
        assert message["type"] == "turn"
        return dict(message["view"])

    def shoot(self, shot: dict[str, Any], key: str = "s", **members: Any) -> dict[str, Any]:
        """The breaker's first stroke; the answer."""
        command = self.stage.command(self.mover, json.dumps({"shot": shot} | members).encode(), key, version=1)
        return dict(json.loads(strokes.shoot(self.stage.context, self.id, lambda _: command).body))

    def concede(self) -> dict[str, Any]:
        """The breaker gives up, which ends the turn; the answer."""
        command = self.stage.command(self.mover, key="c", version=1)
        return dict(json.loads(strokes.concede(self.stage.context, self.id, lambda _: command).body))
