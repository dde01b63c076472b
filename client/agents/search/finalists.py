"""Strokes that are left, and what each is known to be worth."""

from dataclasses import dataclass

import numpy as np

from client.agents.search.shots import Floats, Shots


@dataclass(frozen=True, slots=True, eq=False)
class Finalists:
    """Strokes that were played under noise.

    Attributes:
        shots: (k,) strokes. copies: (k,), how often each was played.
        total, squares: (k,), the sum of what its copies were worth, and of the squares.
    """

    shots: Shots
    copies: Floats
    total: Floats
    squares: Floats

    @classmethod
    def of(cls, shots: Shots, worths: Floats) -> "Finalists":
        """Strokes and what each copy of each was worth, (k, copies)."""
        copies = np.full(len(shots), float(worths.shape[1]))
        return cls(shots, copies, worths.sum(axis=1), (worths * worths).sum(axis=1))

    def __len__(self) -> int:
        return len(self.shots)

    @property
    def worth(self) -> Floats:
        """(k,): what each is worth, as far as known."""
        return self.total / self.copies

    @property
    def error(self) -> Floats:
        """(k,): standard error of that with independent draws; those that are spread evenly err less."""
        variance = np.maximum(0.0, self.squares / self.copies - self.worth**2)
        found: Floats = np.sqrt(variance / np.maximum(1.0, self.copies - 1.0))
        return found

    def best(self, most: int) -> "Finalists":
        """The best of them, the best first."""
        return self[np.argsort(-self.worth, kind="stable")[:most]]

    def __getitem__(self, rows: np.ndarray) -> "Finalists":
        return Finalists(self.shots[rows], self.copies[rows], self.total[rows], self.squares[rows])

    def joined(self, other: "Finalists") -> "Finalists":
        """These and others."""
        sums = (np.concatenate(pair) for pair in zip(self._sums(), other._sums(), strict=True))
        return Finalists(self.shots.joined(other.shots), *sums)

    def again(self, worths: Floats) -> "Finalists":
        """The same, each played some more times, (k, copies)."""
        more = Finalists.of(self.shots, worths)
        return Finalists(self.shots, *(a + b for a, b in zip(self._sums(), more._sums(), strict=True)))

    def _sums(self) -> tuple[Floats, Floats, Floats]:
        return self.copies, self.total, self.squares
