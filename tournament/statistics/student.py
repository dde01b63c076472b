"""Student's distribution, by scipy: imported at the first use, for most who import tournaments never ask."""

from typing import Any


def student_cdf(t: Any, dof: float) -> Any:
    """Probability that Student's t with ``dof`` degrees of freedom is at most ``t``, a number or an array."""
    from scipy.special import stdtr

    return stdtr(dof, t)


def student_quantile(p: float, dof: float) -> float:
    """The t that ``student_cdf`` maps to ``p`` in (0, 1)."""
    from scipy.special import stdtrit

    return float(stdtrit(dof, p))


def sidak_quantile(confidence: float, comparisons: int, dof: float) -> float:
    """The t within which that many estimates stay at once with this confidence; for one, the two-sided quantile.

    Sidak's inequality (JASA 62, 1967, 626-633): they do so at least as often as if they were independent.
    """
    return student_quantile(0.5 + 0.5 * confidence ** (1.0 / max(1, comparisons)), dof)
