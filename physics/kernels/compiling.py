"""How kernels are compiled, and the memory they work on.

Kernels address flat memory: compiled, through raw pointers (an array argument would cost reference counts and
index wrap-around in the innermost functions); interpreted (``NUMBA_DISABLE_JIT=1``), through array views.
The helpers below are the only difference between the two.

Reproducible bits need ``fastmath`` off and no fused multiply-add, which is numba's default; and in kernels no
``**``, ``hypot``, ``pow``, ``numpy.sum`` or ``numpy.linalg``, whose bits differ from machine to machine
(``tests/physics/test_kernel_language.py`` reads the kernels for them).
"""

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

INTERPRETED: bool = bool(numba.config.DISABLE_JIT)
"""Whether kernels run as plain Python."""

INNER: dict[str, Any] = {
    "error_model": "numpy",
    "nogil": True,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}
"""Only kernels call inner kernels: wrappers for other callers would be a third of the time to compile them."""

kernel = numba.njit(**INNER)
"""Decorator of an inner kernel: compiled into the entry points that use it."""

small_kernel = numba.njit(forceinline=True, **INNER)
"""Decorator of a kernel of a few operations: always inlined."""


def _at(builder: Any, address: Any, index: Any, item: Any) -> Any:
    return builder.gep(builder.inttoptr(address, ir.PointerType(item)), [index])


def _loader(item: Any, result: Any) -> Any:
    def load(_typing: Any, memory: Any, index: Any) -> Any:
        def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            return builder.load(_at(builder, arguments[0], arguments[1], item))

        return result(types.intp, types.intp), code

    return intrinsic(load)


def _storer(item: Any, argument: Any) -> Any:
    def store(_typing: Any, memory: Any, index: Any, value: Any) -> Any:
        def code(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            value = arguments[2]
            if value.type != item:
                value = builder.trunc(value, item)
            builder.store(value, _at(builder, arguments[0], arguments[1], item))
            return context.get_dummy_value()

        return types.void(types.intp, types.intp, argument), code

    return intrinsic(store)


def _plain_lowest_bit(bits: int) -> int:
    return (bits & -bits).bit_length() - 1


@intrinsic
def _lowest_bit(_typing: Any, bits: Any) -> Any:
    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], ir.Constant(ir.IntType(1), 1))

    return types.int64(types.int64), code


def _itself(number: int) -> int:
    return number


@intrinsic
def _plain(_typing: Any, _number: Any) -> Any:
    def code(_context: Any, _builder: Any, _signature: Any, arguments: Any) -> Any:
        return arguments[0]

    return types.int64(types.int64), code


def _integers_view(memory: Any, floats: int) -> Any:
    return memory[floats:].view(np.int64)


def _integers_address(memory: int, floats: int) -> int:
    return memory + 8 * floats


def _row_view(array: Any, index: int) -> Any:
    return array[index]


def _row_address(array: Any, index: int) -> Any:
    return array.ctypes.data + index * array.strides[0]


def _plain_load(memory: Any, index: int) -> float:
    return float(memory[index])


def _plain_load_integer(memory: Any, index: int) -> int:
    return int(memory[index])


def _plain_store(memory: Any, index: int, value: Any) -> None:
    memory[index] = value


def _plain_store_fact_number(facts: Any, index: int, value: float) -> None:
    facts.view(np.float64)[index] = value


_double, _int32, _int64 = ir.DoubleType(), ir.IntType(32), ir.IntType(64)

row: Callable[[Any, int], Any] = _row_view if INTERPRETED else numba.njit(nogil=True)(_row_address)
"""``row(array, index)``: memory of one row of a C-contiguous array (n, m)."""

integers_behind: Callable[[Any, int], Any] = (
    _integers_view if INTERPRETED else numba.njit(nogil=True)(_integers_address)
)
"""``integers_behind(memory, floats)``: the int64 memory behind so many float64."""

plain: Callable[[int], int] = _itself if INTERPRETED else _plain
"""``plain(number)``: a constant passed on as any number. numba compiles a function anew for each constant it is called
with; for a large one that is worth preventing."""

lowest_bit: Callable[[int], int] = _plain_lowest_bit if INTERPRETED else _lowest_bit
"""``lowest_bit(bits)``: place of the lowest bit of a set that is not empty."""

load: Callable[[Any, int], float] = _plain_load if INTERPRETED else _loader(_double, types.float64)
"""``load(memory, index)``: a float64."""

store: Callable[[Any, int, float], None] = _plain_store if INTERPRETED else _storer(_double, types.float64)
"""``store(memory, index, value)``: a float64."""

load_integer: Callable[[Any, int], int] = _plain_load_integer if INTERPRETED else _loader(_int64, types.int64)
"""``load_integer(memory, index)``: an int64."""

store_integer: Callable[[Any, int, int], None] = _plain_store if INTERPRETED else _storer(_int64, types.int64)
"""``store_integer(memory, index, value)``: an int64."""

store_fact: Callable[[Any, int, int], None] = _plain_store if INTERPRETED else _storer(_int32, types.int64)
"""``store_fact(facts, index, value)``: an int32."""

store_fact_number: Callable[[Any, int, float], None] = _plain_store_fact_number if INTERPRETED else store
"""``store_fact_number(facts, index, value)``: a float64 behind the int32, ``index`` counting float64."""
