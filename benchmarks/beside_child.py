"""One side of ``beside``: works of local play, events and environments in the checkout that PYTHONPATH names.

Started by file, with the names of the works to warm up: it imports nothing of ``benchmarks``, so that it runs beside an
earlier commit. Each line of its input is a work and a number of units; it answers with CPU seconds and what was done.
"""

import json
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

SEED = 5
Done = tuple[float, int]
"""CPU s, and units done."""


def play(one: str, other: str) -> Callable[[int], Done]:
    """Games in ``client.play``."""

    def run(games: int) -> Done:
        import client

        started = time.process_time()
        client.play(one, other, games=games, seed=SEED)
        return time.process_time() - started, games

    return run


def event(pairs: int) -> Done:
    """An event in this process, with journal and records; its games."""
    from client.arena.directory import EventDirectory
    from client.arena.executors import InProcess
    from client.arena.runner import Runner
    from client.arena.terms import Terms

    entrants = [{"name": "one", "agent": "random"}, {"name": "other", "agent": "random"}]
    values = {"name": "beside", "entrants": entrants, "pairs": pairs, "seconds": None, "seed": SEED}
    with tempfile.TemporaryDirectory() as folder:
        directory = EventDirectory.create(Path(folder) / "event", Terms.from_dict(values).to_dict())
        started = time.process_time()
        ledger = Runner(directory, InProcess()).run()
        return time.process_time() - started, len(ledger.event.counted)


def steps_of(games: int) -> Callable[[int], Done]:
    """Steps of so many games at once, begun anew each time."""

    def run(rounds: int) -> Done:
        from client.learn import ACTION_SIZE, EightBallVectorEnv

        env, chance = EightBallVectorEnv(games), np.random.default_rng(SEED)
        env.reset(seed=SEED)
        actions = chance.uniform(-1.0, 1.0, (rounds, games, ACTION_SIZE)).astype(np.float32)
        started = time.process_time()
        for each in actions:
            env.step(each)
        return time.process_time() - started, rounds * games

    return run


def single(steps: int) -> Done:
    """Steps of one game."""
    from client.learn import ACTION_SIZE, EightBallEnv

    env, chance = EightBallEnv(), np.random.default_rng(SEED)
    env.reset(seed=SEED)
    actions = chance.uniform(-1.0, 1.0, (steps, ACTION_SIZE)).astype(np.float32)
    started = time.process_time()
    for action in actions:
        if env.step(action)[2]:
            env.reset()
    return time.process_time() - started, steps


WORKS: dict[str, Callable[[int], Done]] = {
    "play random": play("random", "random"),
    "play greedy": play("greedy", "greedy"),
    "event random": event,
    "steps, 1024 games": steps_of(1024),
    "steps, 1 game": single,
}


def main() -> None:
    """Answer until the input ends."""
    import physics

    for work in sys.argv[1:]:
        WORKS[work](1)
    tell({"file": physics.__file__})
    for line in sys.stdin:
        work, units = line.rstrip("\n").split("\t")
        tell(WORKS[work](int(units)))


def tell(answer: Any) -> None:
    """One line of output."""
    sys.stdout.write(json.dumps(answer) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
