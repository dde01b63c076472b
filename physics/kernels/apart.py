"""Kernels compiled by themselves: their callers call them by name and hold nothing of their code.

numba links a kernel into every kernel that calls it, and optimises it there anew, up to the entry point: what is at
depth d is optimised d times, and what several call is copied. For the event loop that is half the time to compile, and
for the code of tables with jaws minutes. A kernel ``apart`` is optimised once, and a call of it costs some 2 ns and
more for every array handed over: it is for what is large, or rarely run.

On the other kind of table, and interpreted, it is a kernel like any other. Its code is kept on disk as an entry
point's is; ``load_apart`` binds the names before what calls them is loaded.
"""

import inspect
from collections.abc import Callable
from typing import Any

import llvmlite.binding
import numba
from numba.core import types
from numba.core.cgutils import get_or_insert_function, if_unlikely
from numba.core.typing import signature
from numba.extending import lower_builtin, type_callable

from physics.kernels.compiling import INNER, INTERPRETED

_APART: dict[str, tuple[Any, Any]] = {}
"""Function and signature by name. Modules are read in order of use: none stands before what it calls."""

_LOADED: list[Any] = []
"""Holds the machine code."""


def _type(kind: Any) -> Any:
    """numba's type of ``int``, ``float``, ``bool``, None or a named tuple of them, whose other fields are addresses; an
    array's is named by itself."""
    if kind is None:
        return types.none
    if isinstance(kind, types.Type):
        return kind
    if issubclass(kind, tuple):
        return numba.typeof(kind(*(0.0 if of is float else 0 for of in kind.__annotations__.values())))
    return {int: types.int64, float: types.float64, bool: types.boolean}[kind]


def apart(result: Any, tables: Any, *arguments: Any) -> Callable[[Any], Any]:
    """Decorator of a kernel: with a first argument of a type in ``tables`` it is compiled by itself.

    ``tables``: a class of workspace, or several. Types of the result and of the other arguments:
    ``apart(int, RealWorkspace, float)``; an array by numba's type, see ``entry``.
    """

    def decorate(kernel: Any) -> Any:
        if INTERPRETED:
            return kernel
        of_table = {}
        for table in tables if isinstance(tables, tuple) else (tables,):
            name = f"{kernel.__module__}.{kernel.__qualname__} {table.__name__}"
            kinds = signature(_type(result), _type(table), *map(_type, arguments))
            _APART[name] = kernel.py_func, kinds
            of_table[kinds.args[0]] = name, kinds
        return _chosen(kernel, len(arguments) + 1, of_table)

    return decorate


def _chosen(kernel: Any, count: int, of_table: dict[Any, tuple[str, Any]]) -> Any:
    """What stands for ``kernel`` of ``count`` arguments: by the first one's type a call by name, else itself."""

    def chosen(*_given: Any) -> Any:
        raise TypeError(f"{kernel.__qualname__}: only kernels call it")

    @type_callable(chosen)
    def typed(context: Any) -> Any:
        def typer(*given: Any) -> Any:
            if given[0] in of_table:
                return of_table[given[0]][1]
            return context.resolve_function_type(context.resolve_value_type(kernel), given, {})

        typer.__signature__ = inspect.signature(kernel.py_func)  # type: ignore[attr-defined]
        return typer

    @lower_builtin(chosen, *[types.Any] * count)
    def lower(context: Any, builder: Any, asked: Any, given: Any) -> Any:
        if asked.args[0] not in of_table:
            return context.get_function(context.typing_context.resolve_value_type(kernel), asked)(builder, given)
        name, kinds = of_table[asked.args[0]]
        kept = context.call_conv.get_function_type(kinds.return_type, kinds.args)
        function = get_or_insert_function(builder.module, kept, name)
        status, result = context.call_conv.call_function(builder, function, kinds.return_type, kinds.args, given)
        with if_unlikely(builder, status.is_error):
            context.call_conv.return_status_propagate(builder, status)
        return result

    chosen.py_func = kernel.py_func  # type: ignore[attr-defined]
    return chosen


def load_apart(table: type) -> None:
    """Compile the kernels apart of a class of workspace, or load them, and bind their names."""
    for name, (function, kinds) in _APART.items():
        if kinds.args[0] != _type(table):
            continue
        compiled = numba.njit(kinds, cache=bool(numba.config.CACHE_DIR), **INNER)(function).overloads[kinds.args]
        address = compiled.library.get_pointer_to_function(compiled.fndesc.llvm_func_name)
        llvmlite.binding.add_symbol(name, address)
        _LOADED.append(compiled)
