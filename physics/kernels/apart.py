"""Kernels compiled by themselves on tables with jaws: their callers call them by name and hold nothing of their code.

numba links a kernel into every kernel that calls it, and optimises it there anew, up to the entry point: what is at
depth d is optimised d times, and what several call is copied. For the code of tables with jaws that takes minutes. A
kernel ``apart`` is optimised once, and a call of it costs some 2 ns: it is for what is large, or rarely run.

On tables with straight mouths, and interpreted, it is a kernel like any other. Its code is kept on disk as an entry
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
    """numba's type of ``int``, ``float``, ``bool``, None or a named tuple of them, whose other fields are addresses."""
    if kind is None:
        return types.none
    if issubclass(kind, tuple):
        return numba.typeof(kind(*(0.0 if of is float else 0 for of in kind.__annotations__.values())))
    return {int: types.int64, float: types.float64, bool: types.boolean}[kind]


def apart(result: Any, *arguments: Any) -> Callable[[Any], Any]:
    """Decorator of a kernel: with a first argument of the type named here, it is compiled by itself.

    Types of the result and the arguments: ``apart(int, RealWorkspace, float)``.
    """

    def decorate(kernel: Any) -> Any:
        if INTERPRETED:
            return kernel
        name = f"{kernel.__module__}.{kernel.__qualname__}"
        kinds = signature(_type(result), *map(_type, arguments))
        _APART[name] = kernel.py_func, kinds
        return _chosen(name, kernel, kinds)

    return decorate


def _chosen(name: str, kernel: Any, kinds: Any) -> Any:
    """What stands for ``kernel``: a call by ``name`` if the first argument is that of ``kinds``, else itself."""

    def chosen(*_given: Any) -> Any:
        raise TypeError(f"{name}: only kernels call it")

    @type_callable(chosen)
    def typed(context: Any) -> Any:
        def typer(*given: Any) -> Any:
            if given[0] == kinds.args[0]:
                return kinds
            return context.resolve_function_type(context.resolve_value_type(kernel), given, {})

        typer.__signature__ = inspect.signature(kernel.py_func)  # type: ignore[attr-defined]
        return typer

    @lower_builtin(chosen, *[types.Any] * len(kinds.args))
    def lower(context: Any, builder: Any, asked: Any, given: Any) -> Any:
        if asked.args[0] != kinds.args[0]:
            return context.get_function(context.typing_context.resolve_value_type(kernel), asked)(builder, given)
        kept = context.call_conv.get_function_type(kinds.return_type, kinds.args)
        function = get_or_insert_function(builder.module, kept, name)
        status, result = context.call_conv.call_function(builder, function, kinds.return_type, kinds.args, given)
        with if_unlikely(builder, status.is_error):
            context.call_conv.return_status_propagate(builder, status)
        return result

    chosen.py_func = kernel.py_func  # type: ignore[attr-defined]
    return chosen


def load_apart() -> None:
    """Compile the kernels apart, or load them, and bind their names."""
    for name, (function, kinds) in _APART.items():
        compiled = numba.njit(kinds, cache=bool(numba.config.CACHE_DIR), **INNER)(function).overloads[kinds.args]
        address = compiled.library.get_pointer_to_function(compiled.fndesc.llvm_func_name)
        llvmlite.binding.add_symbol(name, address)
        _LOADED.append(compiled)
