"""Having the physics of a table compiled before clocks run."""

import numpy as np

from physics import Shot, Table, min_elevation, rack, simulate, simulate_batch


def prepare(table: Table) -> None:
    """Play a shot alone and one in a batch: kernels are compiled once on a machine, and loaded once in a process."""
    state = rack(table, "eight_ball", seed=0)
    shot = Shot(1.0, 270.0, min_elevation(table, state, 270.0))
    simulate(table, state, shot)
    row = np.array([[shot.v, shot.phi, shot.theta, shot.a, shot.b]])
    simulate_batch(table, state.positions[None].copy(), row)  # as greedy calls it: compiled for its own kind of array
