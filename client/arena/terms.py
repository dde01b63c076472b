"""The terms of an event as a file: what ``tournament.Spec`` says, and how each entrant is run."""

import hashlib
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from client.arena.directory import EventError
from client.arena.game_task import GameTask
from client.arena.hosting import Hosting
from client.arena.tasks import PairTask
from physics.errors import shown
from physics.table_file import ENDING, read_table
from referee.play.noise_file import read_sigmas
from tournament import RECOMMENDED, Due, Spec, TournamentError, game_seeds


@dataclass(frozen=True, slots=True)
class Terms:
    """What an event needs to be run.

    Attributes:
        spec: the event's terms.
        hosting: how each entrant is run, by name.
    """

    spec: Spec
    hosting: dict[str, Hosting]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read an event file (TOML). One that names neither preset nor table nor noise has the preset `RECOMMENDED`.

        Raises:
            EventError: it cannot be read, or something in it cannot be: field, value and what is allowed.
        """
        try:
            values = tomllib.loads(path.read_text(encoding="utf-8"))
            terms = cls.from_dict(_with_noise(_with_table(_with_preset(values), path.parent), path.parent))
        except (OSError, ValueError, RecursionError) as error:  # no text, no TOML, a number of thousands of digits
            raise EventError(f"{path} cannot be read: {error}") from None
        except EventError as error:
            raise EventError(f"{path}: {error}") from None
        if terms.spec.lots is not None:
            raise EventError(f"{path}: lots = <secret>: must be left out; a server draws them")
        return terms

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read a TOML document, or what ``to_dict`` wrote."""
        if not isinstance(data, dict):
            raise EventError(f"event = {shown(data)}: must be a table")
        values = dict(data)
        tables = values.pop("hosting", {})
        try:
            spec = Spec.from_dict(values)
        except TournamentError as error:
            raise EventError(str(error)) from None
        if not isinstance(tables, dict) or not set(tables) <= set(spec.names):
            names = list(tables) if isinstance(tables, dict) else tables
            allowed = f"must be tables named after entrants: {', '.join(spec.names)}"
            raise EventError(f"hosting = {shown(names)}: {allowed}")
        return cls(spec, {one.name: Hosting.of(one.agent, tables.get(one.name, {})) for one in spec.entrants})

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return self.spec.to_dict() | {"hosting": {name: each.to_dict() for name, each in self.hosting.items()}}

    @property
    def agent_seed(self) -> int:
        """The seed of the shipped agents' choices; it tells nothing of the event's own."""
        text = self.spec.lots or self.spec.seed or 0
        return int.from_bytes(hashlib.sha256(f"pooliad/1 agents {text}".encode()).digest()[:4])

    def game(self, due: Due) -> GameTask:
        """A game as a worker needs it."""
        spec = self.spec
        return GameTask(
            due=due,
            seeds=game_seeds(spec, due.pair, due.leg, due.attempt),
            table=spec.table if isinstance(spec.table, str) else dict(spec.table),
            noise=spec.noise.model(due.pair.noise),
            seconds=spec.seconds,
            simulated_shots=spec.simulated_shots,
        )

    def task(self, games: tuple[Due, ...], directory: Path | None) -> PairTask:
        """The games of a pair as a worker needs them."""
        first, second = games[0].pair.players
        return PairTask(
            games=tuple(self.game(due) for due in games),
            players=(self.hosting[first], self.hosting[second]),
            agent_seed=self.agent_seed,
            directory=None if directory is None else str(directory),
        )


def _with_preset(values: dict[str, Any]) -> dict[str, Any]:
    """The values; where nothing is said of table and noise, with those of the contest that tells players apart."""
    return values if {"preset", "table", "noise"} & values.keys() else values | {"preset": RECOMMENDED}


def _with_table(values: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The values, a table's file read; its name counts from the folder of the event file."""
    table = values.get("table")
    if not isinstance(table, str) or not table.endswith(ENDING):
        return values
    return values | {"table": read_table(folder / table).to_dict()}


def _with_noise(values: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The same with a file of standard deviations read."""
    noise = values.get("noise")
    if not isinstance(noise, dict) or not isinstance(file := noise.get("sigmas"), str):
        return values
    return values | {"noise": noise | {"sigmas": read_sigmas(folder / file).to_dict()}}
