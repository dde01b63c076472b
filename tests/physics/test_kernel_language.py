"""What kernels may not say: operations whose last bit differs between machines, read off their syntax trees.

IEEE 754 fixes the result of + - * /, square roots, comparisons and conversions; ``pow``, ``hypot``, ``exp`` and the
trigonometric functions are the platform's library, ``**`` is another result compiled than interpreted (CPython's x**2
differs from x*x in 0.09 % of doubles), numpy's sums depend on the vector length, and ``fastmath`` lets the compiler
reorder. Golden hashes find most such slips; this finds those on paths no golden scene takes.
"""

import ast
from pathlib import Path

import pytest
from support.require import ROOT

KERNELS = sorted((ROOT / "physics" / "kernels").rglob("*.py"))

MATHEMATICS = {"sqrt", "floor", "inf", "nan", "isnan"}
"""Exact, or rounded once, everywhere."""

NUMPY = {"nan", "full", "int64", "float64"}
"""Values and types; no arithmetic."""

BUILTINS = {"pow", "sum", "round", "divmod"}
"""Functions that would be the library's, or depend on an order."""

PLACES = {("tasks.py", "last[i] // stride"), ("tasks.py", "trace.shape[1] // stride")}
"""Quotients of whole numbers by a variable: the rows of a trace, whose width differs by the kind of table."""

REMAINDERS = {("angles.py", "angle %= 360.0")}
"""``fmod`` is exact (IEEE 754, 5.3.1), but slow: where a remainder may stand."""


def name_of(path: Path) -> str:
    return path.relative_to(ROOT / "physics" / "kernels").as_posix()


def complaints(source: str, file: str = "") -> list[str]:
    """What a kernel's source says that it may not, by line."""
    nodes = ast.walk(ast.parse(source))
    return [f"{file}:{getattr(node, 'lineno', 0)}: {said}" for node in nodes if (said := forbidden(node, file))]


def forbidden(node: ast.AST, file: str) -> str | None:
    if isinstance(node, ast.BinOp | ast.AugAssign):
        return forbidden_operator(node, file)
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        allowed = {"math": MATHEMATICS, "np": NUMPY, "numpy": set(), "cmath": set()}.get(node.value.id)
        return f"{node.value.id}.{node.attr}" if allowed is not None and node.attr not in allowed else None
    if isinstance(node, ast.ImportFrom) and node.module in {"math", "cmath", "numpy", "random"}:
        return f"from {node.module} import"
    if (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id in {"pow", "sum", "round", "divmod"}
    ):
        return f"{node.func.id}()"
    if isinstance(node, ast.keyword) and node.arg in {"fastmath", "parallel"}:
        return str(node.arg)
    return None


def forbidden_operator(node: ast.BinOp | ast.AugAssign, file: str) -> str | None:
    if (file, ast.unparse(node)) in PLACES:
        return None
    if isinstance(node.op, ast.Mod) and (file, ast.unparse(node)) in REMAINDERS:
        return None
    if (
        isinstance(node.op, ast.Pow)
        and isinstance(node, ast.BinOp)
        and is_literal(node.left)
        and is_literal(node.right)
    ):
        return None  # a constant, computed when the module is read
    names = {ast.Pow: "**", ast.Mod: "%", ast.FloorDiv: "//", ast.MatMult: "@"}
    return names.get(type(node.op)) if not is_place(node) else None


def is_literal(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) or (isinstance(node, ast.UnaryOp) and is_literal(node.operand))


def is_place(node: ast.BinOp | ast.AugAssign) -> bool:
    """Whether a quotient is one of places in memory (whole numbers), by a constant of the layout or a literal int."""
    right = node.right if isinstance(node, ast.BinOp) else node.value
    of_layout = isinstance(right, ast.Attribute) and isinstance(right.value, ast.Name) and right.value.id == "at"
    whole = isinstance(right, ast.Constant) and isinstance(right.value, int)
    return isinstance(node.op, ast.FloorDiv) and (of_layout or whole)


@pytest.mark.parametrize("path", KERNELS, ids=name_of)
def test_a_kernel_says_nothing_that_differs_between_machines(path):
    assert complaints(path.read_text(encoding="utf-8"), name_of(path)) == []


@pytest.mark.parametrize(
    "line",
    [
        *("y = x**2", "x **= 2", "y = math.hypot(x, y)", "y = math.sin(x)", "y = math.fma(x, x, x)", "y = pow(x, 2)"),
        *("y = np.sum(x)", "y = np.linalg.norm(x)", "y = np.dot(x, x)", "from math import exp", "y = sum(x)"),
        *("y = x % 2.0", "y = x // z", "y = a @ b", "k = numba.njit(fastmath=True)", "y = math.pow(x, 2.0)"),
    ],
)
def test_each_forbidden_operation_is_seen(line):
    """A rule that sees nothing would pass every kernel."""
    assert complaints(line) != []


def test_numbers_of_columns_stand_in_the_layout_alone():
    """A kernel addresses memory by a name of the layout, a loop's counter or a sum of these: never by a bare number.

    Pairs of coordinates (``2 * i + 1``) are the format of positions, not of the layout.
    """
    found = []
    for path in KERNELS:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
                continue
            reads = node.func.id.startswith(("load", "store")) and len(node.args) > 1
            if reads and isinstance(node.args[1], ast.Constant):
                found.append(f"{name_of(path)}:{node.lineno}: {ast.unparse(node)}")
    assert found == []
