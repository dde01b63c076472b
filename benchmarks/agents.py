"""The shipped `greedy` against `random` at noise 1: games won, called balls made, seconds it thinks about a stroke.

Local games in one process, one after the other; the seconds are wall time of ``choose``, decisions left out.
"""

import time

import numpy as np
from scipy.stats import binomtest

import client
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client.agent import AgentFactory
from protocol import View
from referee import Call

SEED = 8
NOISE = 1.0


class Timed(client.Agent):
    """Another agent, whose thinking about strokes is timed."""

    def __init__(self, agent: client.Agent, seconds: list[float]) -> None:
        self._agent = agent
        self._seconds = seconds

    def game_started(self, view: View) -> None:
        """Hand it on."""
        self._agent.game_started(view)

    def choose(self, view: View) -> client.Action:
        """The agent's action; a stroke's time is kept."""
        started = time.perf_counter()
        action = self._agent.choose(view)
        if action.shot is not None:
            self._seconds.append(time.perf_counter() - started)
        return action


def measure(full: bool) -> Tables:
    """The match of `greedy`; one game before it loads the kernels."""
    against_random("greedy", 1, SEED + 1)
    return {"against_random": [against_random("greedy", 100 if full else 20, SEED)]}


def against_random(name: str, games: int, seed: int) -> Row:
    """How a shipped agent does against `random`, the break alternating."""
    seconds: list[float] = []
    match = client.play(timed(name, seed, seconds), "random", games=games, seed=seed, noise=NOISE)
    winners = [game.outcome.winner for game in match.games]
    won = winners.count(0)
    interval = binomtest(won, games).proportion_ci(0.95)
    strokes = [stroke for game in match.games for stroke in game.strokes if stroke.seat == 0]
    called = [stroke.ruling.made for stroke in strokes if isinstance(stroke.action.call, Call)]
    return {
        "agent": name,
        "games": games,
        "won": won,
        "lost": winners.count(1),
        "won_share_low_95": round(float(interval.low), 4),
        "won_share_high_95": round(float(interval.high), 4),
        "balls_called": len(called),
        "share_made": round(sum(called) / max(1, len(called)), 4),
        "strokes": len(seconds),
        "mean_s": round(float(np.mean(seconds)), 4),
        "median_s": round(float(np.median(seconds)), 4),
        "p95_s": round(float(np.quantile(seconds, 0.95)), 4),
    }


def timed(name: str, seed: int, seconds: list[float]) -> AgentFactory:
    """Makes timed instances of a shipped agent."""
    make = client.load(name, seed)
    return lambda: Timed(make(), seconds)


if __name__ == "__main__":
    main("agents", measure)
