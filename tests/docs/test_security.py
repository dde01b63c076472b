"""docs/security.md names the test that tries each attack: every named test exists, and every attack names one."""

import ast
import re
from pathlib import Path

from support.require import ROOT

PAGE = ROOT / "docs" / "security.md"
ROW = re.compile(r"^\| (?P<attack>[^|]+) \|[^|]*\|[^|]*\| (?P<tests>[^|]+) \|$", re.MULTILINE)


def functions(path: Path) -> set[str]:
    """The tests of a file, those of its classes too."""
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    return {node.name for node in nodes if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)}


def rows() -> list[tuple[str, list[str]]]:
    found = [(row["attack"], re.findall(r"`([\w.]+)`", row["tests"])) for row in ROW.finditer(PAGE.read_text("utf-8"))]
    return [row for row in found if row[0] not in ("attack", "---")]


def test_every_attack_names_tests_and_every_test_exists():
    paths = (ROOT / "tests").rglob("test_*.py")
    there = {f"{path.stem}.{function}" for path in paths for function in functions(path)}
    assert len(rows()) > 50
    for attack, tests in rows():
        assert tests, f"nothing tries: {attack}"
        assert set(tests) <= there, f"{attack}: there is no {set(tests) - there}"


def test_the_attacks_of_the_issue_are_there():
    """Each thing that beat the historical server, and what its successors would try."""
    text = PAGE.read_text(encoding="utf-8")
    for attack in (
        *(
            "foresee the noise",
            "for other noise",
            "own thinking time",
            "exactly zero",
            "passwords",
            "outside the table",
        ),
        *(
            "replay a key",
            "two workers",
            "change a shot",
            "forge the signature",
            "swap or leave out the players' seeds",
        ),
        *("never end", "deeply nested JSON", "guess a token", "flood", "markup"),
    ):
        assert attack in text, attack
