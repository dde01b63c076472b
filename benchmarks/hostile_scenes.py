"""The hostile scenes of every class, by class and seed."""

import numpy as np

import physics
from benchmarks import hostile, hostile_jaws

CLASSES = hostile.CLASSES | hostile_jaws.CLASSES


def table_of(kind: str, rng: hostile.Rng) -> physics.Table:
    """The table that a class is played on."""
    home = hostile if kind in hostile.CLASSES else hostile_jaws
    return home.table_for(kind, rng)


def scene_of(kind: str, seed: int, n: int) -> tuple[physics.Table, hostile.Floats, hostile.Floats]:
    """Table, states and shots of a chunk: the same for the same seed."""
    rng = np.random.default_rng([seed, *kind.encode()])
    table = table_of(kind, rng)
    return table, *CLASSES[kind](table, rng, n)
