"""All shots matched as far as they can be, and the parameters fitted to that.

A shot in a wrong order of events pulls the parameters to where it fits best; only without it is the right order better.
"""

from collections.abc import Callable

import numpy as np

from calibration.joint import JointFit
from calibration.parameters import Parameter
from calibration.staged import CAUGHT, StagedShot
from physics import Table

MOST_ROUNDS = 14
MOST_RELEASES = 3
COARSE_STEPS, FINE_STEPS = 10, 40
FINE, FINE_EVALUATIONS = 1e-6, 8

Observer = Callable[[str, float], None]
"""Told what is being done, and which part of all is done, 0 to 1."""


def match(
    table: Table,
    parameters: tuple[Parameter, ...],
    staged: list[StagedShot],
    rng: np.random.Generator,
    observer: Observer,
) -> JointFit:
    """All shots matched as far as they can be, and the parameters fitted to that."""
    joint = JointFit(table, parameters, [shot.member for shot in staged])
    joint.hold(firmly=True)
    for number in range(MOST_ROUNDS):
        waiting = [shot for shot in staged if not shot.is_whole and not shot.given_up]
        if not waiting:
            break
        done = sum(shot.is_whole for shot in staged)
        observer(f"{done} of {len(staged)} shots followed to their end", number / MOST_ROUNDS)
        for shot in waiting:
            shot.extend(joint.table)
        joint.descend(COARSE_STEPS)
        for shot in waiting:
            shot.judge(joint.table, rng)
    observer("all shots together", 0.8)
    joint.hold(firmly=False)
    _all_together(joint, staged, rng, observer)
    judged = [shot.judge_samples(joint.table) for shot in staged]
    if any(judged):
        _all_together(joint, staged, rng, observer)
    joint.solve(FINE_EVALUATIONS, FINE)
    return joint


def _all_together(joint: JointFit, staged: list[StagedShot], rng: np.random.Generator, observer: Observer) -> None:
    """All shots with full weight, and the orders of events of those that fit badly searched."""
    for shot in staged:
        shot.settle(joint.table)
    joint.descend(FINE_STEPS)
    _search_orders(joint, staged, rng, observer)


def _search_orders(joint: JointFit, staged: list[StagedShot], rng: np.random.Generator, observer: Observer) -> None:
    """Try other orders of events for the shots that fit worst."""
    for number in range(MOST_RELEASES):
        joint.take(joint.values)
        caught = _caught(joint, staged)
        observer(f"{len(caught)} shots caught between two orders of events", 0.85 + 0.05 * number)
        if not caught:
            break
        _release(joint, caught, rng)


def _caught(joint: JointFit, staged: list[StagedShot]) -> list[StagedShot]:
    """The worst of the shots that stop short, fit badly, or lie at an edge of two orders: a third of all at most."""
    badness = [shot.badness(joint.promised(number)) for number, shot in enumerate(staged)]
    worst = np.argsort(badness)[::-1][: max(1, len(staged) // 3)]
    return [staged[number] for number in worst.tolist() if badness[number] > 1.0]


def _release(joint: JointFit, caught: list[StagedShot], rng: np.random.Generator) -> None:
    """Fit the parameters to the other shots alone, find these their order there, and fit all; kept if that is better.

    A shot in a wrong order pulls the parameters to where it fits best; only without it is the right order better. A
    shot that this did not help is not tried again.
    """
    values, before = joint.values, (-sum(shot.counted for shot in caught), joint.cost)
    kept = [(shot, shot.horizon, shot.member.fit, shot.member.weights) for shot in caught]
    silent = [shot.member for shot in caught]
    others = [(one, one.fit) for one in joint.members if one not in silent]
    for shot in caught:
        shot.silence()
    joint.descend(FINE_STEPS)
    for shot, _, fit, weights in kept:
        shot.look_again(joint.table, fit, weights, rng)
    joint.descend(FINE_STEPS)
    helped = (-sum(shot.counted for shot in caught), joint.cost) < (before[0], before[1] - CAUGHT)
    for shot, horizon, fit, weights in kept:
        shot.is_searched = not helped or (shot.is_whole and shot.member.fit.cost > fit.cost - CAUGHT)
        if not helped:
            shot.horizon, shot.member.fit, shot.member.weights = horizon, fit, weights
    if not helped:
        for member, fit in others:
            member.fit = fit
        joint.take(values)
