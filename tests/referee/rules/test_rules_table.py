"""docs/rules.md against the code: every rule has a predicate and a test that exist and name it."""

import ast
import importlib
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from support.require import ROOT

from referee.game import RULES

TESTS = ROOT / "tests" / "referee"
HOW = {"simulated", "by hand", "rack", "refusal", "outside"}


def rows(header: str) -> list[list[str]]:
    text = (ROOT / "docs" / "rules.md").read_text(encoding="utf-8")
    table = text[text.index(header) :].split("\n\n")[0]
    lines = table.splitlines()[2:]
    return [[cell.strip().strip("`") for cell in line.strip("|").split("|")] for line in lines]


RULE_ROWS = rows("| id | rule |")
ERROR_ROWS = rows("| error | rule |")


def resolve(path: str) -> Any:
    module, *names = path.split(".")
    found: Any = importlib.import_module(f"referee.rules.{module}")
    for name in names:
        found = getattr(found, name)
    return found


@cache
def functions(path: Path) -> dict[str, ast.FunctionDef]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}


def test_function(test, folder):
    module, name = test.rsplit(".", 1)
    return functions(folder / f"{module}.py")[name]


test_function.__test__ = False  # type: ignore[attr-defined]


def names_rule(text: str, rule: str) -> bool:
    return re.search(rf"\b{rule}\b", text) is not None


def test_every_rule_is_in_the_table_once_and_in_order():
    assert [row[0] for row in RULE_ROWS] == list(RULES)
    numbers = [f"R{number}" for number in range(1, 52)]
    assert sorted(RULES, key=lambda rule: (int(rule[1:].rstrip("a")), rule)) == list(RULES)
    assert set(RULES) == {*numbers, "R12a"}


def test_every_rule_has_a_predicate_of_its_own():
    predicates = [row[2] for row in RULE_ROWS]
    assert len(set(predicates)) == len(predicates)


@pytest.mark.parametrize("row", RULE_ROWS, ids=lambda row: row[0])
def test_predicate_and_test_exist_and_name_the_rule(row):
    rule, _, predicate, test, how = row
    assert names_rule(resolve(predicate).__doc__, rule)
    function = test_function(test, TESTS / "rules")
    module_doc = ast.get_docstring(ast.parse((TESTS / "rules" / f"{test.split('.')[0]}.py").read_text())) or ""
    assert names_rule(ast.get_docstring(function) or module_doc, rule)
    assert how in HOW


@pytest.mark.parametrize("row", [row for row in RULE_ROWS if row[4] == "simulated"], ids=lambda row: row[0])
def test_simulated_means_simulated(row):
    """The test reaches ``physics.simulate``, by itself or through a helper of its file."""
    helpers = {"play", "simulate", "racked_break", "breaks", "from_kitchen", "miscue", "visits"}
    names = {node.id for node in ast.walk(test_function(row[3], TESTS / "rules")) if isinstance(node, ast.Name)}
    assert helpers & names


@pytest.mark.parametrize("row", ERROR_ROWS, ids=lambda row: row[0])
def test_every_historical_error_has_its_case(row):
    _, cited, test = row
    assert all(rule in RULES for rule in cited.split(", "))
    assert test_function(test, TESTS).name.startswith("test_")


def test_no_rule_is_tested_by_hand_alone():
    """Balls leave some tables, so that every rule about a stroke is shown by one."""
    assert [row[0] for row in RULE_ROWS if row[4] == "by hand"] == []


def test_the_page_says_a_rule_in_the_words_of_the_document():
    """The page explains rule ids by ``referee.RuleId``: one wording, wherever an id is explained."""
    assert {row[0]: row[1] for row in RULE_ROWS} == dict(RULES)
