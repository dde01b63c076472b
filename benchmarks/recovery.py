"""Calibration: are hidden parameters found again, do intervals cover, how long does it take, is a wrong law said so?

Sets of synthetic shots on a table with hidden parameters; each set is fitted from the Olympiad's values. CPU time is of
one thread if the numerical libraries are told to use one (OPENBLAS_NUM_THREADS=1).
"""

import time
from collections.abc import Sequence

import numpy as np

from benchmarks.command import main
from benchmarks.recording import Row, Tables
from calibration import Calibration, calibrate
from calibration.synthetic import Camera, seen
from physics import Table

SEED = 5000
TRUTH = {
    "mu_slide": 0.21,
    "mu_roll": 0.0125,
    "mu_spin": 0.05,
    "e_ball": 0.94,
    "mu_ball": 0.06,
    "cushion_perpendicular": 0.68,
    "cushion_parallel": 0.87,
    "cushion_spin": 0.2,
}
TABLE = Table.olympiad().replace(**TRUTH)
SETS = {True: 400, False: 4}
SIZES = {
    True: ((5, 1e-3, 20.0), (20, 1e-3, 20.0), (30, 1e-3, 20.0), (10, 5e-4, 20.0), (10, 1e-3, 60.0)),
    False: ((30, 1e-3, 20.0),),
}


def measure(full: bool) -> Tables:
    """Coverage over sets of ten shots; one set of other sizes, noise and rates; wrong laws."""
    found = [one_set(10, Camera(), SEED + number) for number in range(SETS[full])]
    return {
        "coverage": [*coverage(found), pooled(found)],
        "sizes": [size(*terms) for terms in SIZES[full]],
        "wrong": [wrong("e_ball", 1.0)],
    }


def one_set(shots: int, camera: Camera, seed: int) -> tuple[Calibration, float]:
    """A fit of eight parameters, and its CPU seconds."""
    observations = seen(TABLE, shots, np.random.default_rng(seed), camera)
    started = time.process_time()
    found = calibrate(Table.olympiad(), observations, tuple(TRUTH))
    return found, time.process_time() - started


def coverage(found: Sequence[tuple[Calibration, float]]) -> list[Row]:
    """A row for each parameter: how often its intervals hold the truth, and its errors in standard errors."""
    rows = []
    for place, (name, truth) in enumerate(TRUTH.items()):
        all_of_it = [one.estimates[place] for one, _ in found]
        errors = np.array([(one.value - truth) / one.sigma for one in all_of_it])
        held = [one.low <= truth <= one.high for one in all_of_it]
        again = [one.bootstrap[0] <= truth <= one.bootstrap[1] for one in all_of_it]
        rows.append(_row(name, held, again, errors, found))
    return rows


def pooled(found: Sequence[tuple[Calibration, float]]) -> Row:
    """The same over all parameters."""
    every = [(est, truth) for one, _ in found for est, truth in zip(one.estimates, TRUTH.values(), strict=True)]
    held = [est.low <= truth <= est.high for est, truth in every]
    again = [est.bootstrap[0] <= truth <= est.bootstrap[1] for est, truth in every]
    return _row("all", held, again, np.array([(est.value - truth) / est.sigma for est, truth in every]), found)


def _row(
    name: str, held: list[bool], again: list[bool], errors: np.ndarray, found: Sequence[tuple[Calibration, float]]
) -> Row:
    return {
        "parameter": name,
        "sets": len(found),
        "covered": round(float(np.mean(held)), 4),
        "covered_by_bootstrap": round(float(np.mean(again)), 4),
        "rms_of_error_in_sigmas": round(float(np.sqrt(np.mean(errors**2))), 3),
        "cpu_seconds_of_a_fit": round(float(np.mean([seconds for _, seconds in found])), 2),
        "unexplained_shots": sum(len(one.unexplained) for one, _ in found),
    }


def size(shots: int, sigma: float, rate: float) -> Row:
    """One set of other terms."""
    found, seconds = one_set(shots, Camera(sigma=sigma, rate=rate), SEED - 1)
    errors = [(one.value - truth) / one.sigma for one, truth in zip(found.estimates, TRUTH.values(), strict=True)]
    return {
        "shots": shots,
        "noise_mm": 1e3 * sigma,
        "rate_hz": rate,
        "parameters": len(TRUTH),
        "cpu_seconds": round(seconds, 2),
        "worst_error_in_sigmas": round(float(np.abs(errors).max()), 2),
        "sigma_of_e_ball": round(found.estimates[3].sigma, 6),
        "unexplained_shots": len(found.unexplained),
    }


def wrong(name: str, value: float) -> Row:
    """A parameter held at a wrong value while another is fitted: does the fit say so?"""
    observations = seen(TABLE, 5, np.random.default_rng(SEED - 2))
    started = time.process_time()
    found = calibrate(TABLE.replace(**{name: value}), observations, ["mu_roll"])
    return {
        "held": f"{name} = {value:g} for {TRUTH[name]:g}",
        "shots": 5,
        "misfit": round(found.misfit, 2),
        "unexplained_shots": len(found.unexplained),
        "said_so": not found.is_trusted,
        "cpu_seconds": round(time.process_time() - started, 2),
    }


if __name__ == "__main__":
    main("recovery", measure)
