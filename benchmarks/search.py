"""The shipped `search` in pairs of games: the same racks, the break exchanged, every game its own noise.

`python -m benchmarks.search play --pairs 20 --first 40 --player search:seconds=1,cpu=on --opponent greedy --noise 1`
plays some pairs and appends a line with one row a pair, so that a long measurement can be made in pieces. `... search
pool` puts all pieces of the present agent, and of earlier ones if they are named, together into a line with one row a
match-up: the one that documents cite. A
piece is repeated exactly if the players are told `shots`; if they are told seconds, up to the machine's speed.
"""

import argparse
import functools
import inspect
import time
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import client
from benchmarks import recording
from benchmarks.recording import Row, Tables
from client.agents.search import SearchAgent
from client.local_game import PlayedGame, play_game
from physics import Table
from physics.engine import digest_of
from physics.table import NAMED
from protocol import View
from referee import Action, Call, EightBall, Stroke
from referee.play import MatchSeed, NoiseModel
from tournament.statistics import score_of_cells

SEED = 2026
"""Of all racks and all noise."""
USUAL = "olympiad"
"""The table unless told, and of pieces that name none."""


@dataclass
class Chair:
    """One player in one game, watched."""

    agent: client.Agent
    started: bool = False
    seconds: float = 0.0
    strokes: int = 0

    def __call__(self, view: View) -> Action:
        """The agent's action; processor time is counted."""
        before = time.process_time()
        if not self.started:
            self.agent.game_started(view)
            self.started = True
            before = time.process_time()  # loading the compiled geometry is not thinking
        action = self.agent.choose(view)
        self.seconds += time.process_time() - before
        self.strokes += action.shot is not None
        return action

    @property
    def simulated(self) -> int:
        """Shots that were simulated, as far as the agent tells."""
        return sum(thought.simulated for thought in getattr(self.agent, "thoughts", []))


@dataclass
class Tally:
    """What one player did in some games."""

    points: float = 0.0
    breaks: int = 0
    runs: int = 0
    called: int = 0
    made: int = 0
    safeties: int = 0
    strokes: int = 0
    seconds: float = 0.0
    simulated: int = 0
    fouls: Counter[str] = field(default_factory=Counter)

    def add(self, game: PlayedGame, seat: int, chair: Chair) -> None:
        """One more game."""
        winner = game.outcome.winner
        self.points += 0.5 if winner is None else float(winner == seat)
        mine = [stroke for stroke in game.strokes if stroke.seat == seat and stroke.shot is not None]
        if game.header.start.breaker == seat:
            self.breaks += 1
            self.runs += winner == seat and all(stroke.seat == seat for stroke in game.strokes)
        calls = [stroke.ruling.made for stroke in mine if isinstance(stroke.action.call, Call)]
        self.called, self.made = self.called + len(calls), self.made + sum(calls)
        self.safeties += sum(stroke.action.is_safety for stroke in mine)
        self.fouls.update(f"{_kind(stroke)}{rule}" for stroke in mine for rule in stroke.ruling.fouls)
        self.strokes, self.seconds = self.strokes + chair.strokes, self.seconds + chair.seconds
        self.simulated += chair.simulated

    def row(self) -> Row:
        """As plain values."""
        row: Row = {name: getattr(self, name) for name in _COUNTED}
        return row | {"seconds": round(self.seconds, 3), "fouls": dict(sorted(self.fouls.items()))}


_COUNTED = ("points", "breaks", "runs", "called", "made", "safeties", "strokes", "simulated")


def _kind(stroke: Stroke) -> str:
    """Fouls on the break are counted apart."""
    return "break " if stroke.action.call is None else ""


def play_pair(players: tuple[str, str], noise: float, table: str, pair: int) -> Row:
    """Two games on the same racks; each player breaks one of them."""
    rules = EightBall(Table.named(table))
    seed = MatchSeed.of(SEED)
    factories = [client.load(name, seed=SEED + pair) for name in players]
    tallies = (Tally(), Tally())
    for breaker in (0, 1):
        number = 2 * pair + breaker
        chairs = Chair(factories[0]()), Chair(factories[1]())
        seeds = seed.game(number, pairs=True)
        game = play_game(rules, chairs, seeds, NoiseModel(noise), breaker=breaker, number=number)
        for seat, chair in enumerate(chairs):
            tallies[seat].add(game, seat, chair)
    first, second = (tally.row() for tally in tallies)
    return {
        "pair": pair,
        "player": players[0],
        "opponent": players[1],
        "noise": noise,
        "table": table,
        "of_player": first,
    } | {"of_opponent": second}


def play(players: tuple[str, str], noise: float, table: str, first: int, pairs: int, seconds: float) -> Tables:
    """Some pairs, one after the other; no new one is begun after so many seconds."""
    started, rows, agent = time.monotonic(), [], agent_digest()
    for pair in range(first, first + pairs):
        rows.append(play_pair(players, noise, table, pair) | {"agent": agent})
        if time.monotonic() - started > seconds:
            break
    return {"pairs": rows}


@functools.cache
def agent_digest() -> str:
    """Which version of the agent: a hash of its sources."""
    return digest_of(Path(str(inspect.getfile(SearchAgent))).parent)[:12]


def pool(versions: list[list[str]]) -> Tables:
    """All pairs of these versions of the agent, by match-up.

    Args:
        versions: in groups whose play does not differ, the present one first; each row names those it holds.
    """
    group_of = {version: place for place, group in enumerate(versions) for version in group}
    found: dict[tuple[int, str, str, float, str], dict[int, Row]] = defaultdict(dict)
    for line in recording.lines("search"):
        for row in line["tables"].get("pairs", []):
            if row["agent"] in group_of:
                key = group_of[row["agent"]], row["player"], row["opponent"], row["noise"], row.get("table", USUAL)
                found[key][row["pair"]] = row
    matches = {key: match_row(*key[1:], list(rows.values())) for key, rows in sorted(found.items())}
    return {
        "matches": list(matches.values()),
        "strength": [strength_row(row) for key, row in matches.items() if key[0] == 0 and row["opponent"] == "greedy"],
        "parts": [part_row(row) for row in matches.values() if row["opponent"].endswith("=off")],
    }


def strength_row(match: Row) -> Row:
    """What a match-up against `greedy` says of the agent's strength."""
    kept = ("noise", "table", "score", "low_95", "high_95", "break_and_run", "opponent_break_and_run", "share_made")
    return (
        {"player": match["player"].removesuffix(",cpu=on"), "games": 2 * match["pairs"]}
        | {name: match[name] for name in kept}
        | {name: match[name] for name in ("seconds_per_stroke", "shots_per_stroke", "fouls")}
    )


def part_row(match: Row) -> Row:
    """What a match-up against the agent without one of its parts says of that part's worth."""
    budget, _, part = match["opponent"].removesuffix("=off").rpartition(",")
    kept = (
        "noise",
        "table",
        "score",
        "elo",
        "elo_low_95",
        "elo_high_95",
        "shots_per_stroke",
        "opponent_shots_per_stroke",
    )
    row = {"part": part, "player": budget, "agents": match["agents"], "games": 2 * match["pairs"]}
    return row | {name: match[name] for name in kept}


def score_row(cells: Counter[int]) -> Row:
    """The score of pairs with its interval and in Elo; ``cells``: pairs by twice their points, 0 to 4."""
    score = score_of_cells([cells[cell] for cell in range(5)])
    return {
        "pairs": cells.total(),
        "score": round(score.score, 4),
        "low_95": round(score.low, 4),
        "high_95": round(score.high, 4),
        "elo": round(score.elo, 1),
        "elo_low_95": round(score.elo_low, 1),
        "elo_high_95": round(score.elo_high, 1),
    }


def match_row(player: str, opponent: str, noise: float, table: str, pairs: list[Row]) -> Row:
    """One match-up: the score with its interval from pairs, and what both did."""
    halves = Counter(round(2.0 * row["of_player"]["points"]) for row in pairs)
    mine, theirs = (summed([row[side] for row in pairs]) for side in ("of_player", "of_opponent"))
    fouls: Counter[str] = Counter()
    for row in pairs:
        fouls.update(row["of_player"]["fouls"])
    return {
        "player": player,
        "opponent": opponent,
        "noise": noise,
        "table": table,
        "agents": " ".join(sorted({row["agent"] for row in pairs})),
        **score_row(halves),
        "break_and_run": round(mine["runs"] / max(1, mine["breaks"]), 4),
        "opponent_break_and_run": round(theirs["runs"] / max(1, theirs["breaks"]), 4),
        "called": mine["called"],
        "share_made": round(mine["made"] / max(1, mine["called"]), 4),
        "opponent_share_made": round(theirs["made"] / max(1, theirs["called"]), 4),
        "safeties": mine["safeties"],
        "strokes": mine["strokes"],
        "seconds_per_stroke": round(mine["seconds"] / max(1, mine["strokes"]), 4),
        "shots_per_stroke": round(mine["simulated"] / max(1, mine["strokes"])),
        "opponent_shots_per_stroke": round(theirs["simulated"] / max(1, theirs["strokes"])),
        "fouls": dict(sorted(fouls.items())),
    }


def summed(rows: list[Row]) -> Row:
    """The counts of several tallies."""
    return {name: sum(row[name] for row in rows) for name in (*_COUNTED, "seconds")}


def measure(full: bool) -> Tables:
    """A look at the present agent; the cited figures are pooled from pieces."""
    shots, pairs = (20_000, 20) if full else (1_000, 1)
    return play((f"search:shots={shots}", "greedy"), 1.0, USUAL, 0, pairs, seconds=3600.0)


def main() -> None:
    """Play a piece, or pool them all."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.search")
    commands = parser.add_subparsers(required=True, dest="command")
    pooled = commands.add_parser("pool")
    pooled.add_argument(
        "versions",
        nargs="*",
        default=[agent_digest()],
        help="the present one unless given; those whose play is the same joined by +, the present one first",
    )
    piece = commands.add_parser("play")
    piece.add_argument("--player", default="search:seconds=1,cpu=on")
    piece.add_argument("--opponent", default="greedy")
    piece.add_argument("--noise", type=float, default=1.0)
    piece.add_argument("--table", default=USUAL, choices=tuple(NAMED))
    piece.add_argument("--first", type=int, default=0)
    piece.add_argument("--pairs", type=int, default=10)
    piece.add_argument("--seconds", type=float, default=240.0)
    given = parser.parse_args()
    todo: Callable[[bool], Tables] = lambda _full: pool([group.split("+") for group in given.versions])  # noqa: E731
    if given.command == "play":
        players = given.player, given.opponent
        todo = lambda _full: play(players, given.noise, given.table, given.first, given.pairs, given.seconds)  # noqa: E731
    recording.run("search", todo, full=given.command == "pool")


if __name__ == "__main__":
    main()
