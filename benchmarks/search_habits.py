"""The study behind the values of `search`: what typically happens in its games against itself, by level of noise.

How good is the next shot of a player who goes on, and the first one of a player who comes to the table after a miss, a
safety or a foul? How often do misses and safeties foul? And does a position reckoned to be worth so much win so often?
The first answers are copied into `client/agents/search/race.py`, which cites the data line; the last one checks them.
"""

import itertools
from collections import defaultdict

import numpy as np

import client
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client.agents.search.shots import CHANCE, PLACED, SEEN
from client.agents.search.sight import Sight
from client.agents.search.thinking import GROUPS
from client.agents.search.value import Values
from client.local_game import PlayedGame
from physics import Table
from referee import Call, Phase, Stroke

SEED = 40
GAMES = {0.0: 20, 1.0: 60, 5.0: 12}
"""By level of noise, in a full run."""
SHOTS = 4000
TABLE = Table.olympiad()
ARRIVALS = ("after_pot", "after_miss", "after_safety", "in_hand")
GOOD = 0.6
"""A shot of this chance is a good one: the mixtures are the means above and below it, with their shares."""
BINS = (0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.01)


def measure(full: bool) -> Tables:
    """All levels of noise."""
    arrivals: list[Row] = []
    fouls: list[Row] = []
    worth: list[Row] = []
    for level in GAMES:
        games = played(level, GAMES[level] if full else 4)
        arrivals += arrival_rows(level, games)
        fouls.append(foul_row(level, games))
        worth += worth_rows(level, games)
    return {"arrivals": arrivals, "fouls": fouls, "worth": worth}


def played(level: float, games: int) -> list[PlayedGame]:
    """Games of the agent against itself."""
    name = f"search:shots={SHOTS}"
    return list(client.play(name, name, games=games, seed=SEED, noise=level).games)


def strokes_of(game: PlayedGame) -> list[tuple[Stroke | None, Stroke]]:
    """Every called stroke with the stroke before it."""
    before = (None, *game.strokes[:-1])
    return [(last, one) for last, one in zip(before, game.strokes, strict=True) if one.action.call is not None]


def offered(level: float, last: Stroke) -> tuple[float, bool]:
    """The chance of the best pot on the table that a stroke left, and whether any ball could be struck straight."""
    game = last.game
    hand = game.cue_ball_in_hand is not None
    offers = Sight(TABLE, level).survey(game.state.positions[None].copy(), np.array([hand]))[0]
    group = GROUPS[game.group_of(game.turn)]
    mine = offers.max(axis=0) if group < 0 else offers[group]
    return float(mine[PLACED if hand else CHANCE]), bool(mine[SEEN] > 0.0)


def kind_of(last: Stroke | None, one: Stroke) -> str | None:
    """How the shooter came to this stroke; None right after a break or a decision."""
    if last is None or not last.action.call or last.game.phase is not Phase.PLAY:
        return None
    if last.ruling.fouls:
        return "in_hand"
    if last.seat == one.seat:
        return "after_pot"
    return "after_safety" if last.action.is_safety else "after_miss"


def arrival_rows(level: float, games: list[PlayedGame]) -> list[Row]:
    """Chances of the shots that players face."""
    found: dict[str, list[float]] = defaultdict(list)
    for game in games:
        for last, one in strokes_of(game):
            kind = kind_of(last, one)
            if kind and last is not None:
                found[kind].append(offered(level, last)[0])
    return [arrival_row(level, kind, np.array(found[kind])) for kind in ARRIVALS]


def arrival_row(level: float, kind: str, chances: np.ndarray) -> Row:
    """One way of coming to a shot."""
    good = chances >= GOOD
    return {
        "noise": level,
        "arrival": kind,
        "strokes": len(chances),
        "mean": _rounded(chances),
        "good": _rounded(good),
        "mean_good": _rounded(chances[good]),
        "mean_bad": _rounded(chances[~good]),
    }


def foul_row(level: float, games: list[PlayedGame]) -> Row:
    """How often strokes foul."""
    misses, safeties, hidden, made = [], [], [], []
    for game in games:
        for last, one in strokes_of(game):
            fouled = bool(one.ruling.fouls)
            seen = last is None or one.action.cue_ball or last.game.phase is not Phase.PLAY or offered(level, last)[1]
            if not seen:
                hidden.append(fouled)
                continue
            if isinstance(one.action.call, Call):
                made.append(one.ruling.made)
                misses += [] if one.ruling.made else [fouled]
            else:
                safeties.append(fouled)
    return {
        "noise": level,
        "called_made": _rounded(made),
        "misses": len(misses),
        "miss_fouls": _rounded(misses),
        "safeties": len(safeties),
        "safety_fouls": _rounded(safeties),
        "hidden": len(hidden),
        "hidden_fouls": _rounded(hidden),
    }


def worth_rows(level: float, games: list[PlayedGame]) -> list[Row]:
    """What positions were reckoned to be worth to the shooter, and how often the shooter won."""
    values = Values(Sight(TABLE, level), level)
    reckoned, won = [], []
    for game in games:
        for last, _ in strokes_of(game):
            if last is None or last.game.phase is not Phase.PLAY or game.outcome.winner is None:
                continue
            after = last.game
            hand, group = np.array([after.cue_ball_in_hand is not None]), GROUPS[after.group_of(after.turn)]
            positions = after.state.positions[None]
            reckoned.append(float(values.to_shoot(positions, np.array([group], np.int8), hand)[0]))
            won.append(game.outcome.winner == after.turn)
    of, did = np.array(reckoned), np.array(won)
    rows = []
    for low, high in itertools.pairwise(BINS):
        inside = (of >= low) & (of < high)
        if inside.any():
            row = {"noise": level, "from": low, "strokes": int(inside.sum())}
            rows.append(row | {"reckoned": _rounded(of[inside]), "won": _rounded(did[inside])})
    return rows


def _rounded(values: object) -> float | None:
    """The mean, three decimals; None of nothing."""
    array = np.asarray(values, dtype=float)
    return round(float(array.mean()), 3) if array.size and not np.isnan(array).any() else None


if __name__ == "__main__":
    main("search_habits", measure)
