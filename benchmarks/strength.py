"""How strong players are, from lock-step games (`benchmarks.lockstep`): score, Elo, and why turns and games are lost.

`python -m benchmarks.strength play --player search:shots=10000 --opponent search:shots=1000 --noise 2 --pairs 1500
--plan "1,500 pairs, decided before the first"` plays one match-up and appends a line. The number of pairs is told
beforehand and played whole; a line says what was planned. `... pool LINE ...` puts lines together into one, for tables
in documents. `search:seconds=0.1,cpu=on@8336b41` is the player of that commit, in a checkout of its own. Match-ups of
players with `shots` are repeated exactly.
"""

import argparse
from collections import Counter
from collections.abc import Sequence

import numpy as np
from scipy.stats import binomtest

from benchmarks import recording
from benchmarks.lockstep import MatchUp, Played, Turn, play
from benchmarks.recording import Row, Tables
from benchmarks.search import score_row
from client.agents.search.shots import CHANCE
from client.agents.search.sight import Sight
from physics import Table
from physics.table import NAMED

SHORT = (
    MatchUp(("search:shots=400", "greedy"), noise=1.0, pairs=2),
    MatchUp(("search:shots=400", "search:shots=200"), noise=5.0, table="nine_foot", pairs=4),
)
FULL = tuple(
    MatchUp(("search:shots=10000", "search:shots=1000"), noise=noise, table=table, pairs=500)
    for table in ("olympiad", "nine_foot")
    for noise in (1.0, 2.0, 5.0)
)
"""What `pooliad bench strength` plays: hours of processor time in full."""
NO_POT, HARD, FAIR = 0.1, 0.5, 0.8
"""Limits of the best straight pot's chance. Below the first there is no pot; then hard, fair and easy ones."""
CAUSES = ("no_pot", "hard", "fair", "easy_missed", "easy_declined")
DECILES = 10
CALLS = (("ball", True), ("safety", False))


def measure(full: bool) -> Tables:
    """All match-ups of the plan."""
    return tables(FULL if full else SHORT, "as the plan in benchmarks/strength.py")


def tables(matches: Sequence[MatchUp], plan: str) -> Tables:
    """Play match-ups, and what came of them."""
    results: list[Row] = []
    ends: list[Row] = []
    reckoned: list[Row] = []
    calls: list[Row] = []
    for match in matches:
        games = play(match)
        results.append(match_row(match, games) | {"plan": plan})
        for player in (0, 1):
            ends.append(end_row(match, games, player))
            reckoned += reckoned_rows(match, games, player)
            calls += call_rows(match, games, player)
    return {"matches": results, "ends": ends, "reckoned": reckoned, "calls": calls}


def match_row(match: MatchUp, games: Sequence[Played]) -> Row:
    """The score with its interval from pairs, and what both did."""
    points: Counter[int] = Counter()
    for game in games:
        points[game.pair] += 1 if game.winner is None else 2 * (game.winner == 0)
    cells = Counter(points.values())
    return {
        **named(match),
        "seed": match.seed,
        **score_row(cells),
        **{f"cells_{cell}": cells[cell] for cell in range(5)},
        **side(games, 0, ""),
        **side(games, 1, "opponent_"),
    }


def named(match: MatchUp) -> Row:
    """Which match-up."""
    return {"player": match.players[0], "opponent": match.players[1], "noise": match.noise, "table": match.table}


def side(games: Sequence[Played], player: int, prefix: str) -> Row:
    """What one player did."""
    broke = [game for game in games if game.breaker == player]
    runs = sum(game.run_out for game in broke)
    interval = binomtest(runs, max(1, len(broke))).proportion_ci(0.95)
    lost = [game for game in games if game.winner == 1 - player]
    strokes = max(1, sum(game.strokes[player] for game in games))
    called = [turn.made for game in games for turn in game.turns if turn.seat == player and turn.called]
    row = {
        "breaks": len(broke),
        "breaks_kept": round(sum(game.kept for game in broke) / max(1, len(broke)), 4),
        "breaks_won": round(sum(game.winner == player for game in broke) / max(1, len(broke)), 4),
        "break_and_run": round(runs / max(1, len(broke)), 4),
        "break_and_run_low_95": round(float(interval.low), 4),
        "break_and_run_high_95": round(float(interval.high), 4),
        "lost": len(lost),
        "lost_winnable": sum(bool(game.strokes[player]) for game in lost),
        "called": len(called),
        "share_made": round(float(np.mean(called)) if called else 0.0, 4),
        "shots_per_stroke": round(sum(game.simulated[player] for game in games) / strokes),
        "seconds_per_stroke": round(sum(game.seconds[player] for game in games) / strokes, 4),
    }
    return {f"{prefix}{name}": value for name, value in row.items()}


def end_row(match: MatchUp, games: Sequence[Played], player: int) -> Row:
    """Why a player's turns at the table ended, short of winning: by the best straight pot that it had."""
    ended = [turn for game in games for turn in _ends(game, player)]
    sight, counts = Sight(Table.named(match.table), match.noise), Counter[str]()
    if ended:
        positions = np.array([turn.positions for turn in ended])
        offers = sight.survey(positions, np.zeros(len(ended), bool))[:, :, CHANCE]
        groups = np.array([turn.group for turn in ended])
        best = np.where(groups < 0, offers.max(axis=1), offers[np.arange(len(ended)), groups])
        counts.update(_cause(turn, chance) for turn, chance in zip(ended, best.tolist(), strict=True))
    return {**named(match), "of": match.players[player], "turns": len(ended)} | {each: counts[each] for each in CAUSES}


def _ends(game: Played, player: int) -> list[Turn]:
    """The strokes after which a player left the table, but for the stroke that won."""
    mine = [turn for turn in game.turns if turn.seat == player and not turn.goes_on]
    return mine[:-1] if game.winner == player and mine and mine[-1] is game.turns[-1] else mine


def _cause(turn: Turn, chance: float) -> str:
    if chance < NO_POT:
        return "no_pot"
    if chance < HARD:
        return "hard"
    if chance < FAIR:
        return "fair"
    return "easy_missed" if turn.called else "easy_declined"


def reckoned_rows(match: MatchUp, games: Sequence[Played], player: int) -> list[Row]:
    """What strokes were reckoned to be worth, by tenths, beside how often they led to a won game."""
    known = [
        (turn.worth, float(game.winner == player))
        for game in games
        for turn in game.turns
        if turn.seat == player and turn.worth is not None and game.winner is not None
    ]
    if not known:
        return []
    worth, won = np.array(known).T
    decile = np.minimum((worth * DECILES).astype(int), DECILES - 1)
    losses = {"log_loss": log_loss(worth, won), "log_loss_of_constant": log_loss(np.full(len(won), won.mean()), won)}
    return [
        {**named(match), "of": match.players[player], "from": round(each / DECILES, 1), "strokes": int(here.sum())}
        | {"reckoned": round(float(worth[here].mean()), 3), "won": round(float(won[here].mean()), 3)}
        | losses
        for each in range(DECILES)
        if (here := decile == each).any()
    ]


def call_rows(match: MatchUp, games: Sequence[Played], player: int) -> list[Row]:
    """What pots and safeties were reckoned to be worth, beside how often they led to a won game."""
    known = [
        (turn.called, turn.worth, float(game.winner == player))
        for game in games
        for turn in game.turns
        if turn.seat == player and turn.worth is not None and game.winner is not None
    ]
    rows = [(name, [(worth, won) for each, worth, won in known if each == called]) for name, called in CALLS]
    return [
        {**named(match), "of": match.players[player], "call": name, "strokes": len(some)}
        | {"reckoned": round(float(np.mean(some, axis=0)[0]), 3), "won": round(float(np.mean(some, axis=0)[1]), 3)}
        for name, some in rows
        if some
    ]


def log_loss(chance: np.ndarray, won: np.ndarray) -> float:
    """Mean of minus the logarithm of the chance given to what happened; certainties count as 0.999."""
    known = np.clip(chance, 0.001, 0.999)
    return round(float(-np.mean(np.where(won > 0.5, np.log(known), np.log(1.0 - known)))), 4)


def pooled(names: Sequence[str]) -> Tables:
    """The tables of several lines as one, each row with the line that it is from.

    Raises:
        ValueError: there is no such line.
    """
    known = {line["id"]: line for line in recording.lines("strength")}
    for name in names:
        if name not in known:
            raise ValueError(f"line = {name!r}: must be the id of a line in {recording.path_of('strength').name}")
    return {
        title: _filled([row | {"line": name} for name in names for row in known[name]["tables"].get(title, ())])
        for title in ("matches", "ends", "reckoned", "calls")
    }


def _filled(rows: list[Row]) -> list[Row]:
    """The rows with the columns of all of them: earlier lines have fewer."""
    columns = {name: None for row in rows for name in row}
    return [columns | row for row in rows]


def main() -> None:
    """Play one match-up, or the plan; or put lines together."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.strength")
    commands = parser.add_subparsers(dest="command")
    one = commands.add_parser("play")
    one.add_argument("--player", required=True)
    one.add_argument("--opponent", required=True)
    one.add_argument("--noise", type=float, required=True)
    one.add_argument("--table", default="olympiad", choices=tuple(NAMED))
    one.add_argument("--pairs", type=int, required=True, help="decided beforehand, and played whole")
    one.add_argument("--first", type=int, default=0)
    one.add_argument("--seed", type=int, default=0)
    one.add_argument("--plan", required=True, help="what was decided before the first game, and why")
    commands.add_parser("pool").add_argument("lines", nargs="+", help="ids of lines, to be shown in one table")
    parser.add_argument("--full", action="store_true")
    given = parser.parse_args()
    if given.command is None:
        recording.run("strength", measure, given.full)
        return
    if given.command == "pool":
        recording.run("strength", lambda _full: pooled(given.lines), full=True)
        return
    match = MatchUp((given.player, given.opponent), given.noise, given.table, given.seed, given.first, given.pairs)
    recording.run("strength", lambda _full: tables([match], given.plan), full=True)


if __name__ == "__main__":
    main()
