"""These kernels beside those of an earlier commit in one run: bits, instructions, time and compile time.

What a change of form must not change. Two processes, one a commit, play the same scenes in turn; time is the median
over pairs of neighbouring runs, so that a loaded machine slows both; instructions are counted by callgrind.
"""

import pickle
import shutil
import statistics
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

import physics
from benchmarks import scenes, speed
from benchmarks.checkouts import Child, checkout
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables

BASE = "8336b41"
"""Version 0.1.0."""

CHILD = ROOT / "benchmarks" / "against_child.py"
COUNTED = 4
"""One shot in so many is played under callgrind, which is fifty times slower."""

STARTS = 8
"""Of the processes that are timed."""

PLAIN = {"NUMBA_CPU_NAME": "x86-64-v3", "NUMBA_CPU_FEATURES": ""}
"""Compiled for what valgrind knows; a processor's own instructions it may not."""

Scenes = dict[str, dict[str, Any]]


def measure(full: bool) -> Tables:
    """All tables of this benchmark."""
    with checkout(BASE) as base, tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sides = {"base": Side(folder, base), "now": Side(folder, ROOT)}
        shots, pairs = (8_000 if full else 2_000), 32
        return {
            "compile": list(compiling(sides, 3 if full else 1)),
            "instructions": list(instructions(sides, every_scene(shots // COUNTED))),
            "time": list(times(sides, every_scene(shots), pairs)),
        }


def every_scene(shots: int) -> Scenes:
    """The scenes of ``speed``, and what they leave out: contacts of many bodies, the historical laws, a trace."""
    table, old = physics.Table.olympiad(), physics.Table.fastfiz()
    found = {name: scene(table, *arrays) for name, *arrays in speed.workloads(shots)}
    rng = np.random.default_rng(2)
    states, strokes = scenes.breaks(table, rng, shots // 8)
    found["break, historical"] = scene(old, states, strokes)
    found["break, traced"] = scene(table, *scenes.played(table, states, strokes), traced=True)
    found["4 balls, traced"] = scene(table, *scenes.playable_mid_game(table, rng, shots // 2, 4), traced=True)
    touching = scenes.racks(table, shots // 8, gap=0.0)
    found["touching break"] = scene(table, *scenes.played(table, touching, strokes))
    found["frozen to a cushion"] = scene(table, *frozen(table, rng, shots // 2))
    return found


def scene(table: physics.Table, states: scenes.Floats, shots: scenes.Floats, traced: bool = False) -> dict[str, Any]:
    """As a child process takes it."""
    return {"table": table.to_dict(), "states": states, "shots": shots, "traced": traced}


def frozen(table: physics.Table, rng: np.random.Generator, n: int) -> tuple[scenes.Floats, scenes.Floats]:
    """Three touching balls on the south cushion, struck at."""
    radius = table.ball_radius
    states = scenes.nobody(n)
    for ball in range(1, 4):
        states[:, ball] = 0.4 + 2.0 * radius * ball, radius
    states[:, 0] = rng.uniform([0.2, 0.5], [0.9, 1.5], (n, 2))
    shots = rng.uniform([2.0, 0.0, 5.0, -5.0, -5.0], [6.0, 0.0, 10.0, 5.0, 5.0], (n, 5))
    way = states[:, 2] - states[:, 0] + rng.uniform(-radius, radius, (n, 2))
    shots[:, 1] = np.degrees(np.arctan2(way[:, 1], way[:, 0]))
    return scenes.played(table, states, shots)


class Side:
    """One of the commits compared: its checkout and the compiled kernels it keeps.

    Attributes:
        tree: the checkout.
    """

    def __init__(self, folder: Path, tree: Path) -> None:
        self.tree = tree
        self._folder = folder
        self._cache = Path(tempfile.mkdtemp(dir=folder))

    def forget(self) -> None:
        """Compile anew the next time."""
        shutil.rmtree(self._cache)
        self._cache.mkdir()

    def start(self, given: Scenes, plain: bool = False, under: tuple[str, ...] = ()) -> Child:
        """A process that plays ``given``; ``under``: a command that runs it."""
        path = self._folder / "scenes"
        path.write_bytes(pickle.dumps(given))
        places = {"POOLIAD_CACHE_DIR": str(self._cache)} | (PLAIN if plain else {})
        return Child(self.tree, (str(CHILD), str(path)), environment=places, under=under)


def compiling(sides: dict[str, Side], pairs: int) -> Iterator[Row]:
    """CPU time of compiling all kernels with nothing cached, in turn; the median of pairs."""
    found: dict[str, list[float]] = {name: [] for name in sides}
    for _ in range(pairs):
        for name, side in sides.items():
            side.forget()
            with side.start({}) as child:
                found[name].append(float(child.first["compile"]))  # CPU s
    ratios = [now / base for base, now in zip(found["base"], found["now"], strict=True)]
    yield {
        "pairs": pairs,
        "base_s": round(statistics.median(found["base"]), 2),
        "now_s": round(statistics.median(found["now"]), 2),
        "ratio": round(statistics.median(ratios), 3),
    }


def instructions(sides: dict[str, Side], given: Scenes) -> Iterator[Row]:
    """Instructions that callgrind counts, the call's Python included; nothing where there is no valgrind."""
    counts = {name: counted(side, given) for name, side in sides.items()}
    if not all(counts.values()):
        return
    for scene in given:
        base, now = counts["base"][scene], counts["now"][scene]
        shots = len(given[scene]["shots"])
        yield {
            "scene": scene,
            "shots": shots,
            "base_per_shot": round(base / shots),
            "now_per_shot": round(now / shots),
            "ratio": round(now / base, 4),
        }


def counted(side: Side, given: Scenes) -> dict[str, int]:
    """Instructions of each scene; nothing where there is no valgrind."""
    if shutil.which("valgrind") is None:
        return {}
    with side.start(given, plain=True) as child:  # compiled where it is fast
        for scene in given:
            child.ask(f"time {scene}")
    with tempfile.TemporaryDirectory() as out:
        tool = ("valgrind", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}/out", "-q")
        with side.start(given, plain=True, under=tool) as child:
            for scene in given:
                child.ask(f"count {scene}")
        dumps = {int(path.suffix[1:]): path.read_text() for path in Path(out).glob("out.*")}
    return {scene: total(dumps[place]) for place, scene in enumerate(given, 1)}


def total(dump: str) -> int:
    """The instructions of one dump."""
    return next(int(line.split()[1]) for line in dump.splitlines() if line.startswith("totals:"))


def times(sides: dict[str, Side], given: Scenes, pairs: int) -> Iterator[Row]:
    """CPU time of both, in turn: the median over pairs of their ratio; whether all outputs have the same bits.

    Processes are started several times, each side first as often as the other: where a process' memory happens to lie
    changes its time by some per cent, and the one that is started first is the slower of two equals.
    """
    same, rows = dict.fromkeys(given, True), {scene: list[tuple[float, float]]() for scene in given}
    for turn in range(STARTS):
        for scene, alike, found in _in_turn(sides, given, -(-pairs // STARTS), reverse=turn % 2 == 1):
            same[scene] &= alike
            rows[scene] += found
    for scene, found in rows.items():
        shots = len(given[scene]["shots"])
        yield {
            "scene": scene,
            "shots": shots,
            "same_bits": same[scene],
            "base_us": round(statistics.median(row[0] for row in found) / shots * 1e6, 3),
            "now_us": round(statistics.median(row[1] for row in found) / shots * 1e6, 3),
            "ratio": round(statistics.median(row[1] / row[0] for row in found), 4),
        }


def _in_turn(
    sides: dict[str, Side], given: Scenes, pairs: int, reverse: bool
) -> Iterator[tuple[str, bool, list[tuple[float, float]]]]:
    """Of each scene, by two fresh processes: its name, whether the outputs are the same, times of base and now, s."""
    with ExitStack() as stack:
        order = sorted(sides, reverse=reverse)
        children = {name: stack.enter_context(sides[name].start(given)) for name in order}
        for scene in given:
            hashes = {child.ask(f"bits {scene}") for child in children.values()}
            played = [{name: float(children[name].ask(f"time {scene}")) for name in order} for _ in range(pairs)]
            yield scene, len(hashes) == 1, [(one["base"], one["now"]) for one in played]


if __name__ == "__main__":
    main("against", measure)
