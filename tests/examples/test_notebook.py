"""The notebook in `examples`, run from its first cell to its last, and what its cells show."""

import ast
import io
import json
import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("matplotlib").use("Agg")

NOTEBOOK = json.loads((Path(__file__).parents[2] / "examples" / "shots.ipynb").read_text())


def shown(cell, names):
    """What a cell's last expression comes to, as a notebook shows it; None without one."""
    tree = ast.parse(cell)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    return None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)


def test_every_cell_runs_and_shows_something():
    names: dict[str, Any] = {"__name__": "__main__"}
    cells = ["".join(cell["source"]) for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"]
    values = [shown(cell, names) for cell in cells]
    assert None not in values
    assert values[0]._repr_svg_().startswith("<svg"), "the first cell draws a table"
    assert values[1]._repr_svg_().startswith("<svg")
    assert names["result"].facts.pocketed[3] >= 0, "the shot pots its ball"
    assert values[2]._repr_svg_().startswith("<svg")
    shares = list(names["shares"])
    assert shares[0] == 1.0
    assert shares == sorted(shares, reverse=True)
    assert names["good"].all(), "geometry aims at every speed and height of the tip"
    for value in values:
        if hasattr(value, "savefig"):
            value.savefig(drawn := io.BytesIO())
            assert len(drawn.getvalue()) > 5000
    assert re.search("<iframe|<svg", values[-2]._repr_html_())


def test_it_is_kept_without_what_a_run_leaves():
    """Outputs would be old ones, and large."""
    assert NOTEBOOK["nbformat"] == 4
    for cell in NOTEBOOK["cells"]:
        assert cell["cell_type"] == "markdown" or (cell["outputs"], cell["execution_count"]) == ([], None)
