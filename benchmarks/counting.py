"""Floating-point operations of compiled code, counted: it runs as plain Python on numbers that count."""

import functools
import math
import operator
import sys
from collections.abc import Callable
from typing import Any

COUNT = [0]
"""Additions, subtractions, multiplications, divisions and square roots so far."""


class Counted(float):
    """A float whose arithmetic is counted."""

    __slots__ = ()

    def __neg__(self) -> "Counted":
        return Counted(-float(self))

    def __abs__(self) -> "Counted":
        return Counted(abs(float(self)))


def _counting(operation: Callable[[float, float], float], swapped: bool) -> Callable[[Any, Any], Any]:
    def method(self: Counted, other: Any) -> Any:
        if not isinstance(other, int | float):
            return NotImplemented
        COUNT[0] += 1
        pair = (float(other), float(self)) if swapped else (float(self), float(other))
        return Counted(operation(*pair))

    return method


for _name in ("add", "sub", "mul", "truediv"):
    setattr(Counted, f"__{_name}__", _counting(getattr(operator, _name), swapped=False))
    setattr(Counted, f"__r{_name}__", _counting(getattr(operator, _name), swapped=True))


class Mathematics:
    """``math`` with counted square roots."""

    def __getattr__(self, name: str) -> Any:
        return getattr(math, name)

    def sqrt(self, x: float) -> Counted:
        """A counted square root."""
        COUNT[0] += 1
        return Counted(math.sqrt(x))

    def copysign(self, x: float, y: float) -> Counted:
        """Not arithmetic, but its result goes on being counted."""
        return Counted(math.copysign(x, y))


def count_in(prefix: str) -> None:
    """Let the loaded modules under ``prefix`` take their square roots from ``Mathematics``."""
    for name, module in list(sys.modules.items()):
        if name.startswith(prefix) and getattr(module, "math", None) is math:
            module.math = Mathematics()  # type: ignore[attr-defined]


@functools.wraps(float)
def counted_load(memory: Any, index: int) -> Counted:
    """``load`` of the kernels, interpreted, giving a number that counts."""
    return Counted(memory[index])
