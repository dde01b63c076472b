"""What `pooliad demo` sets up and runs: a server, two agents as processes, one match, its account."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from client.adapters.stdio import LOGS
from client.agents.registry import titles
from client.arena.journal import Journal
from client.cli import embedded
from client.cli.output import fail, say
from client.cli.processes import Child
from client.cli.reports import REPORTS
from client.cli.sentences import sentence_of, summary
from client.cli.spectator import Ended, Played, follow
from client.cli.tally import GameTally
from client.http import Pooliad
from client.prepare import prepare
from physics import Table
from protocol import AgentView, GameSummary, MatchRequest, MatchView, NoiseTerms
from referee.play import MatchSeed

LONGEST_WORDS = 300
"""Letters of a bad answer that are shown; its log has all of them."""
LEAVING_SECONDS = 15.0
"""Seconds the agents get to learn that the match is over: less than two of their polls need."""


class DemoSession:
    """A server and two agent processes, all of them children of this process.

    Args:
        started: where new children are put; whoever made the list ends them.
        directory: for the database, the records and the logs.
        agents: names for `pooliad agent run`.
        seed: of the match and of the agents' choices.
        quiet: say nothing while playing.
    """

    def __init__(self, started: list[Child], directory: Path, agents: tuple[str, str], seed: int, quiet: bool) -> None:
        self._children = started
        self._directory = directory
        self._agents = agents
        self._seed = seed
        self._say: Callable[[str], None] = (lambda text: None) if quiet else say
        self._games: list[dict[str, Any]] = []
        self._reports: dict[str, Journal] = {}
        self._told: dict[str, str] = {}

    def play(self, games: int, noise: float, table: Table) -> dict[str, Any]:
        """Play the match and return its account, as JSON."""
        self._say("preparing the physics (compiled once, then kept)")
        prepare(table)  # by one process instead of three
        server = embedded.start(self._children, self._directory)
        with Pooliad(server.url, server.organiser) as organiser:
            entered = zip(titles(*self._agents), self._agents, strict=True)
            players = [self._enter(organiser, server.url, name, program) for name, program in entered]
            request = MatchRequest(
                agents=(players[0].id, players[1].id),
                games=games,
                table=table.to_dict(),
                noise=NoiseTerms(level=noise),
                seed=MatchSeed.of(self._seed).secret.hex(),
            )
            match = organiser.create_match(request)
            first, second = match.players
            self._say(f"{first} against {second}, table {table.name}, noise {noise:g}, seed {self._seed}")
            self._watch(organiser, match)
            return self._finish(organiser.match(match.id))

    def _enter(self, organiser: Pooliad, url: str, name: str, program: str) -> AgentView:
        """Register an agent and start its process."""
        entry = organiser.register(name)
        command = [sys.executable, "-P", "-m", "client.cli", "agent", "run", program, "--seed", str(self._seed)]
        reports = self._directory / f"{name}.reports.jsonl"
        environment = {"POOLIAD_URL": url, "POOLIAD_TOKEN": entry.token}
        environment |= {REPORTS: str(reports), LOGS: str(self._directory)}
        self._children.append(Child(name, command, self._directory / f"{name}.log", environment))
        self._reports[name] = Journal(reports)
        return entry.agent

    def _watch(self, organiser: Pooliad, match: MatchView) -> None:
        """Tell the match stroke by stroke, and keep each game's record."""
        tally = GameTally()
        for happening in follow(organiser, match.id, self._check):
            self._tell_reports()
            match happening:
                case Played(stroke=stroke):
                    tally.add(stroke)
                    self._say(sentence_of(stroke, match.players))
                case Ended(game=game):
                    self._close(organiser, match, game, tally)
                    tally = GameTally()

    def _close(self, organiser: Pooliad, match: MatchView, game: GameSummary, tally: GameTally) -> None:
        """Keep a finished game's record and say how it ended."""
        record = self._directory / f"game-{game.number + 1}.jsonl"
        record.write_bytes(organiser.record(game.id))
        keys = self._directory / "keys.json"
        keys.write_text(organiser.keys().model_dump_json(indent=2) + "\n", encoding="utf-8")
        value = tally.value(game, match.players, record, keys)
        self._games.append(value)
        for line in summary(value, match.players):
            self._say(line)

    def _finish(self, match: MatchView) -> dict[str, Any]:
        """Let the agents leave, and account for the match."""
        for child in self._children[1:]:
            if child.wait(LEAVING_SECONDS) is None:
                fail(f"{child.name} still runs although the match is over:\n{child.last_words()}")
        self._check()
        self._say(f"match {match.status}: {' '.join(_score(match))}; logs and records in {self._directory}")
        return {
            "match": match.id,
            "status": match.status,
            "seed": self._seed,
            "noise": match.noise.level,
            "table": match.table["name"],
            "agents": list(match.players),
            "score": list(match.score),
            "winner": None if match.winner is None else match.players[match.winner],
            "directory": str(self._directory),
            "games": self._games,
        }

    def _tell_reports(self) -> None:
        """Say what the agents do wrong as it happens; the same again, try after try, is said once."""
        for name, journal in self._reports.items():
            for entry in journal.new():
                words = (
                    f"{entry.fields['words']}: {error}" if (error := entry.fields["error"]) else entry.fields["words"]
                )
                if words != self._told.get(name):
                    self._told[name] = words
                    self._say(f"   !  {name}: {shortened(words)}")

    def _check(self) -> None:
        """Tell of bad answers, and leave the command if a child has failed."""
        self._tell_reports()
        for child in self._children:
            if child.exit_code not in (None, 0):
                fail(f"{child.name} left with exit code {child.exit_code}:\n{child.last_words()}")


def _score(match: MatchView) -> tuple[str, str]:
    """Each player with the games won."""
    return f"{match.players[0]} {match.score[0]:g},", f"{match.players[1]} {match.score[1]:g}"


def shortened(words: str) -> str:
    """What fits a line."""
    line = " ".join(words.split())
    return line if len(line) <= LONGEST_WORDS else f"{line[:LONGEST_WORDS]}..."
