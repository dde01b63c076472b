"""Parameters of the table from all shots at once, the nuisances of each shot eliminated by itself.

Variable projection (Golub & Pereyra 1973, in Kaufman's form): the residuals are a function of the parameters alone, at
the nuisances that are best for them; their derivatives are those by the parameters, projected off those by the
nuisances, shot by shot. The normal matrix is then the Schur complement of the nuisances, a sum over shots.
"""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import least_squares

from calibration.observed import Floats
from calibration.parameters import Parameter, replaced
from calibration.reduced import Curvature, Member, Reduced
from calibration.shot_fit import FIRST_DAMPING, MOST_BEND, MOST_DAMPINGS, PROBE, ShotFit, fit_shot
from physics import Table

CHORD_STEPS = 3
"""Steps with known slopes that bring nuisances back to their best after a small change of the parameters."""
CHORD_ENOUGH = 1e-3
"""Fall of a shot's cost below which they end; costs count standard deviations squared."""
CHORD_LEFT, FOLLOW_STEPS = 0.05, 6
"""Fall of a shot's cost that is still promised after them, above which it takes steps of its own, and how many."""
DESCENT_ENOUGH = 0.03
"""Fall of the cost in a step, in standard deviations squared, below which a descent ends."""
RELATIVE_STEP = 1e-6
"""Of a finite difference by a parameter."""
HELD_OF_START, HELD_OF_RANGE = 0.5, 0.05
"""Standard deviation of a parameter that is held: part of its value at the start, or of its range if that is more."""
AT_EDGE = 1e-6
"""Part of its range that keeps a parameter's start off its bounds, as the method demands."""


class JointFit:
    """Least squares over the parameters, with a state: every member's nuisances follow.

    Attributes:
        values: (p,) the parameters. members: the shots. parts: what each shot says, at ``values``.
    """

    def __init__(self, table: Table, parameters: Sequence[Parameter], members: list[Member]) -> None:
        self._table, self._parameters = table, tuple(parameters)
        self._names = [one.name for one in parameters]
        self.members = members
        low, high = (np.array([getattr(one, end) for one in parameters]) for end in ("low", "high"))
        self._low, self._high = low, high
        margin = AT_EDGE * (high - low)
        self._start = np.array([one.start for one in parameters])
        self._hold = high - low
        self.values = np.clip(self._start, low + margin, high - margin)
        self.parts: list[Curvature] = []
        self._tried: dict[bytes, list[ShotFit | None]] = {}

    def hold(self, firmly: bool) -> None:
        """Hold parameters by where the fit begins: firmly while shots are matched in part, else next to not at all.

        The first meetings say little of some parameters, which would wander to where later ones say nothing of them.
        """
        width = self._high - self._low
        firm = np.maximum(HELD_OF_START * np.abs(self._start), HELD_OF_RANGE * width)
        self._hold = firm if firmly else width

    @property
    def table(self) -> Table:
        """The table at ``values``."""
        return self.table_at(self.values)

    def table_at(self, values: Floats) -> Table:
        """The table with these parameters."""
        return replaced(self._table, self._names, values.tolist())

    def solve(self, most: int, tolerance: float) -> None:
        """Go to the least cost; at most ``most`` evaluations of all shots."""
        self._tried = {}
        self._linearise(self.values)
        found = least_squares(
            self._residuals,
            self.values,
            jac=self._slopes,
            bounds=(self._low, self._high),
            x_scale="jac",
            ftol=tolerance,
            xtol=tolerance,
            gtol=None,
            max_nfev=most,
        )
        if not np.array_equal(found.x, self.values):
            self._linearise(found.x)

    def take(self, values: Floats) -> None:
        """Go back to these parameters, the members' fits being those that belong to them."""
        self._tried = {}
        self._linearise(values)

    def _residuals(self, values: Floats) -> Floats:
        """All shots' rows, then those that hold a parameter which the data say nothing of."""
        fits = self._fits(values)
        rows = [
            np.full(len(member.weights), 1e3) if fit is None else fit.residuals
            for member, fit in zip(self.members, fits, strict=True)
        ]
        return np.concatenate((*rows, (values - self._start) / self._hold))

    def _slopes(self, values: Floats) -> Floats:
        if not np.array_equal(values, self.values):
            self._linearise(values)
        rows = [
            part.by_parameters - fit_space @ (fit_space.T @ part.by_parameters)
            for part, fit_space in zip(self.parts, self._spaces, strict=True)
        ]
        return np.concatenate((*rows, np.diag(1.0 / self._hold)))

    def _fits(self, values: Floats) -> list[ShotFit | None]:
        key = values.tobytes()
        if key not in self._tried:
            table = self.table_at(values)
            shift = values - self.values
            self._tried[key] = [
                self._followed(member, follow, table, shift)
                for member, follow in zip(self.members, self._follow, strict=True)
            ]
        return self._tried[key]

    def _followed(
        self, member: Member, follow: tuple[Floats, Floats, Floats], table: Table, shift: Floats
    ) -> ShotFit | None:
        """A member's nuisances for other parameters: predicted, then improved with the slopes that are known."""
        inverse, by_parameters, space = follow
        model, fit = member.model, member.fit
        there = fit.nuisances - model.scales * (inverse @ (by_parameters @ shift))
        found = model.residuals(table, there)
        if found is None:
            return fit_shot(model, table, fit.nuisances, member.weights)
        best = ShotFit(there, member.weights * found, fit.slopes)
        for _ in range(CHORD_STEPS):
            there = best.nuisances - model.scales * (inverse @ best.residuals)
            found = model.residuals(table, there)
            if found is None:
                break
            next_one = ShotFit(there, member.weights * found, fit.slopes)
            fall = best.cost - next_one.cost
            if fall > 0.0:
                best = next_one
            if fall < CHORD_ENOUGH * (1.0 + 1e-3 * best.cost):
                break
        if float(np.sum((space.T @ best.residuals) ** 2)) > CHORD_LEFT:
            again = fit_shot(model, table, best.nuisances, member.weights, steps=FOLLOW_STEPS)
            return best if again is None else again
        return best

    def _linearise(self, values: Floats) -> None:
        """Take these parameters and their nuisances, and find all slopes there."""
        if self._tried:
            for member, fit in zip(self.members, self._fits(values), strict=True):
                if fit is not None:
                    member.fit = fit
        self.values = values
        table = self.table
        stepped = [self._stepped(number) for number in range(len(values))]
        self.parts, self._spaces, self._follow = [], [], []
        for member in self.members:
            refined = self._refined(member, table)
            member.fit = refined
            by_parameters = self._by_parameters(member, stepped)
            space, triangle = np.linalg.qr(refined.slopes)
            projected = by_parameters - space @ (space.T @ by_parameters)
            gradient = projected.T @ refined.residuals
            self.parts.append(Curvature(projected.T @ projected, gradient, by_parameters))
            self._spaces.append(space)
            self._follow.append((np.linalg.solve(triangle, space.T), by_parameters, space))
        self._tried = {values.tobytes(): [member.fit for member in self.members]}

    def _refined(self, member: Member, table: Table) -> ShotFit:
        """The member's fit with slopes of its own place."""
        nuisances = member.fit.nuisances
        plain, slopes = member.model.linearised(table, nuisances)
        if np.isnan(plain[0]):
            return member.fit
        return ShotFit(nuisances, member.weights * plain, member.weights[:, None] * slopes)

    def _stepped(self, number: int) -> tuple[float, Table]:
        """A step of one parameter within its range, and the table there."""
        step = RELATIVE_STEP * max(abs(float(self.values[number])), 0.01)
        if self.values[number] + step > self._high[number]:
            step = -step
        values = self.values.copy()
        values[number] += step
        return step, self.table_at(values)

    def _by_parameters(self, member: Member, stepped: list[tuple[float, Table]]) -> Floats:
        steps = np.array([step for step, _ in stepped])
        found = member.model.rows_on([table for _, table in stepped], member.fit.nuisances)
        columns: Floats = (member.weights * found - member.fit.residuals) / steps[:, None]
        return np.nan_to_num(columns.T)

    def descend(self, most: int) -> None:
        """Damped steps of parameters and nuisances together, at most this many: from afar, along curved valleys.

        Levenberg and Marquardt's method with geodesic acceleration, each step's equations reduced shot by shot.
        """
        damping = FIRST_DAMPING
        self._tried = {}  # fits of before: the members' weights or fits may be others now
        for _ in range(most):
            self._linearise(self.values)
            step = self._step(damping)
            if step is None:
                return
            damping, fall = step
            if fall < DESCENT_ENOUGH * (1.0 + 1e-4 * self.cost):
                return

    def _step(self, damping: float) -> tuple[float, float] | None:
        """Lower the cost by a step; the next damping, and by how much the cost fell. None if no step lowers it."""
        residuals = [member.fit.residuals for member in self.members]
        cost = self.cost
        for _ in range(MOST_DAMPINGS):
            reduced = Reduced(self.members, self.parts, self._held(), damping)
            held = self._held() @ (self.values - self._start)
            shift, moves = reduced.solve(residuals, held)
            ahead = self._moved(PROBE * shift, [PROBE * move for move in moves])
            if ahead is not None:
                bends = [
                    2.0
                    / PROBE
                    * ((fit.residuals - before) / PROBE - member.fit.slopes @ move - part.by_parameters @ shift)
                    for fit, before, member, part, move in zip(
                        ahead, residuals, self.members, self.parts, moves, strict=True
                    )
                ]
                bend, bend_moves = reduced.solve([0.5 * one for one in bends], np.zeros_like(held))
                length = sum(float(move @ move) for move in moves) ** 0.5
                bent = sum(float(move @ move) for move in bend_moves) ** 0.5
                if bent <= MOST_BEND * length:
                    shift, moves = shift + bend, [move + one for move, one in zip(moves, bend_moves, strict=True)]
                    fits = self._moved(shift, moves)
                    if fits is not None and sum(fit.cost for fit in fits) < cost:
                        self.values = np.clip(self.values + shift, self._low, self._high)
                        for member, fit in zip(self.members, fits, strict=True):
                            member.fit = fit
                        self._tried = {}
                        return 0.15 * damping, cost - self.cost
            damping *= 4.0
        return None

    def _moved(self, shift: Floats, moves: list[Floats]) -> list[ShotFit] | None:
        """Every shot at other parameters and nuisances, its slopes left as they are; None if one is unplayable."""
        table = self.table_at(np.clip(self.values + shift, self._low, self._high))
        fits = []
        for member, move in zip(self.members, moves, strict=True):
            there = member.fit.nuisances + member.model.scales * move
            found = member.model.residuals(table, there)
            if found is None:
                return None
            fits.append(ShotFit(there, member.weights * found, member.fit.slopes))
        return fits

    def _held(self) -> Floats:
        return np.diag(1.0 / self._hold**2)

    @property
    def cost(self) -> float:
        """Of all shots."""
        return sum(member.fit.cost for member in self.members)

    def promised(self, number: int) -> float:
        """By how much the slopes say that one shot's cost could still fall.

        Next to nothing at a smooth minimum; more where a shot is caught at the edge between two orders of events.
        """
        along = self._spaces[number].T @ self.members[number].fit.residuals
        return float(along @ along)

    def information(self) -> Floats:
        """(p, p) normal matrix of all shots, nuisances eliminated, with what holds undetermined parameters."""
        return sum((part.normal for part in self.parts), self._held())
