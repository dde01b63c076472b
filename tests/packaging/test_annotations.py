"""The convention of tests/mypy.ini: tests have no annotations; mypy holds that other functions have all or none."""

import ast

from support.require import ROOT


def annotated_tests(text):
    """Names of the tests in a module's text that have annotations."""
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    return [
        one.name
        for one in functions
        if one.name.startswith("test_")
        and (
            one.returns is not None or any(isinstance(node, ast.arg) and node.annotation for node in ast.walk(one.args))
        )
    ]


def test_no_test_has_annotations():
    found = {
        str(path.relative_to(ROOT)): annotated_tests(path.read_text()) for path in (ROOT / "tests").rglob("test_*.py")
    }
    assert {path: names for path, names in found.items() if names} == {}
    assert len(found) > 150


def test_an_annotation_is_found_wherever_it_stands():
    text = "def test_a(x: int): ...\ndef test_b() -> None: ...\ndef test_c(x): ...\n"
    text += "class C:\n    def test_d(self, *, y: int): ...\n"
    assert annotated_tests(text) == ["test_a", "test_b", "test_d"]
