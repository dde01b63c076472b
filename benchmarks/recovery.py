"""Calibration: are hidden parameters found again, do intervals cover, how long does it take, is a wrong law said so?

Sets of synthetic shots on tables with hidden parameters; each set is fitted from the named table's values. CPU time is
of one thread if the numerical libraries are told to use one (OPENBLAS_NUM_THREADS=1).

    python -m benchmarks.recovery              # a few sets, a minute or two
    python -m benchmarks.recovery --sets 200   # that many on the Olympiad's table, a quarter as many on nine_foot
    python -m benchmarks.recovery --full       # 400 and 100
    python -m benchmarks.recovery --full --minutes 30   # as many of these as half an hour allows
"""

import argparse
import dataclasses
import math
import time
from collections.abc import Sequence

import numpy as np

from benchmarks import recording
from benchmarks.recording import Row, Tables
from calibration import Calibration, calibrate
from calibration.laws import compare_laws
from calibration.synthetic import Camera, seen
from physics import Table

SEED = 5000
FULL, SHORT = 400, 4
NINE_FOOT_EVERY = 4
"""Sets of the Olympiad's table for each set of a nine-foot table, whose fits take longer."""
SIZES = {
    True: ((5, 1e-3, 20.0), (20, 1e-3, 20.0), (30, 1e-3, 20.0), (10, 5e-4, 20.0), (10, 1e-3, 60.0)),
    False: ((30, 1e-3, 20.0),),
}


@dataclasses.dataclass(frozen=True)
class Hidden:
    """A table whose parameters are to be found, and where a fit begins."""

    before: Table
    truth: dict[str, float]
    seed: int

    @property
    def table(self) -> Table:
        """With the hidden parameters."""
        return self.before.replace(**self.truth)


OLYMPIAD = Hidden(
    Table.olympiad(),
    {
        "mu_slide": 0.21,
        "mu_roll": 0.0125,
        "mu_spin": 0.05,
        "e_ball": 0.94,
        "mu_ball": 0.06,
        "cushion_perpendicular": 0.68,
        "cushion_parallel": 0.87,
        "cushion_spin": 0.2,
    },
    SEED,
)
NINE_FOOT = Hidden(
    Table.nine_foot(),
    {"mu_slide": 0.215, "mu_roll": 0.0115, "mu_spin": 0.05, "e_ball": 0.94, "e_cushion": 0.81, "mu_cushion": 0.17},
    SEED + 2000,
)
TRUTH = OLYMPIAD.truth


def measure(full: bool) -> Tables:
    """Of many sets, or of a few."""
    return measured(FULL if full else SHORT)


def measured(sets: int, minutes: float = math.inf) -> Tables:
    """Sets of other sizes, noise and rates; wrong laws; coverage over sets of ten shots, as many as time allows."""
    end = time.monotonic() + 60.0 * minutes
    sizes = [size(*terms) for terms in SIZES[sets > SHORT]]
    wrongs = [wrong("e_ball", 1.0), wrong_law()]
    found: dict[str, list[tuple[Calibration, float]]] = {OLYMPIAD.before.name: [], NINE_FOOT.before.name: []}
    for number in range(sets):
        for hidden in (OLYMPIAD, NINE_FOOT) if number % NINE_FOOT_EVERY == 0 else (OLYMPIAD,):
            found[hidden.before.name].append(one_set(hidden, 10, Camera(), hidden.seed + number))
        if time.monotonic() > end:
            break
    tables = [(hidden, found[hidden.before.name]) for hidden in (OLYMPIAD, NINE_FOOT)]
    return {
        "coverage": [row for hidden, fitted in tables for row in coverage(hidden, fitted)],
        "fits": [fits(hidden, fitted) for hidden, fitted in tables],
        "sizes": sizes,
        "wrong": wrongs,
    }


def one_set(hidden: Hidden, shots: int, camera: Camera, seed: int) -> tuple[Calibration, float]:
    """A fit of all hidden parameters, and its CPU seconds."""
    observations = seen(hidden.table, shots, np.random.default_rng(seed), camera)
    started = time.process_time()
    found = calibrate(hidden.before, observations, tuple(hidden.truth))
    return found, time.process_time() - started


def coverage(hidden: Hidden, found: Sequence[tuple[Calibration, float]]) -> list[Row]:
    """A row for each parameter and one for all: how often intervals hold the truth, and errors in standard errors."""
    held, again, errors = (
        np.array(
            [
                [of(one, truth) for one, truth in zip(fit.estimates, hidden.truth.values(), strict=True)]
                for fit, _ in found
            ]
        )
        for of in (
            lambda one, truth: one.low <= truth <= one.high,
            lambda one, truth: one.bootstrap[0] <= truth <= one.bootstrap[1],
            lambda one, truth: (one.value - truth) / one.sigma,
        )
    )
    columns = [(name, slice(place, place + 1)) for place, name in enumerate(hidden.truth)]
    return [
        {
            "table": hidden.before.name,
            "parameter": name,
            "sets": len(found),
            "covered": round(float(held[:, part].mean()), 4),
            "covered_by_bootstrap": round(float(again[:, part].mean()), 4),
            "rms_of_error_in_sigmas": round(float(np.sqrt((errors[:, part] ** 2).mean())), 3),
        }
        for name, part in (*columns, ("all", slice(None)))
    ]


def fits(hidden: Hidden, found: Sequence[tuple[Calibration, float]]) -> Row:
    """What the fits of a table took, and how many say that they are to be trusted."""
    seconds = [spent for _, spent in found]
    return {
        "table": hidden.before.name,
        "sets": len(found),
        "trusted": sum(one.is_trusted for one, _ in found),
        "unexplained_shots": sum(len(one.unexplained) for one, _ in found),
        "samples_left_out": sum(shot.outliers for one, _ in found for shot in one.shots),
        "cpu_seconds_of_a_fit": round(float(np.mean(seconds)), 2),
        "at_most": round(max(seconds), 2),
        "under_5_seconds": round(float(np.mean(np.array(seconds) < 5.0)), 3),
    }


def size(shots: int, sigma: float, rate: float) -> Row:
    """One set of other terms."""
    found, seconds = one_set(OLYMPIAD, shots, Camera(sigma=sigma, rate=rate), SEED - 1)
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
    observations = seen(OLYMPIAD.table, 5, np.random.default_rng(SEED - 2))
    started = time.process_time()
    found = calibrate(OLYMPIAD.table.replace(**{name: value}), observations, ["mu_roll"])
    return {
        "held": f"{name} = {value:g} for {TRUTH[name]:g}",
        "shots": 5,
        "misfit": round(found.misfit, 2),
        "unexplained_shots": len(found.unexplained),
        "said_so": not found.is_trusted,
        "cpu_seconds": round(time.process_time() - started, 2),
    }


def wrong_law() -> Row:
    """Cushions after Mathavan et al. (2010), fitted by Han's law (2005) and by their own."""
    cloth = Table.nine_foot().replace(flight=False)
    shots = 6
    observations = seen(
        cloth.replace(cushion="mathavan"), shots, np.random.default_rng(3), Camera(sigma=5e-4, rate=60.0)
    )
    started = time.process_time()
    best, other = compare_laws(cloth, observations, ["e_cushion", "mu_cushion", "mu_slide"], ["han", "mathavan"])
    return {
        "held": f"cushion = {other.law} for {best.law}",
        "shots": shots,
        "misfit": round(other.calibration.misfit, 2),
        "unexplained_shots": len(other.calibration.unexplained),
        "said_so": best.law == "mathavan" and other.is_refuted and not other.calibration.is_trusted,
        "cpu_seconds": round(time.process_time() - started, 2),
    }


def main() -> None:
    """Append a line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sets", type=int, default=SHORT, help=f"on the Olympiad's table; a full run has {FULL}")
    parser.add_argument("--full", dest="sets", action="store_const", const=FULL)
    parser.add_argument("--minutes", type=float, default=math.inf, help="no longer than this, and the last set")
    told = parser.parse_args()
    if told.sets < 1:
        parser.error(f"--sets = {told.sets}: must be 1 or more")
    recording.run(
        "recovery", lambda _: measured(told.sets, told.minutes), told.sets >= FULL and math.isinf(told.minutes)
    )


if __name__ == "__main__":
    main()
