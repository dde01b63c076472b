"""Benchmarks as data (issue "exact, fast, never wrong"): lines are complete, and documents cite lines that exist."""

import importlib
import inspect
import json
import re

import pytest

from benchmarks import recording, report
from benchmarks.catalogue import BENCHMARKS

LINES = [(name, line) for name in BENCHMARKS for line in recording.lines(name)]


def test_every_line_says_what_made_it():
    for name, line in LINES:
        assert line["benchmark"] == name
        assert line["id"].startswith(f"{name}-")
        assert {"commit", "uncommitted", "kernels", "machine", "versions", "full", "tables"} <= set(line)
    assert len({line["id"] for _, line in LINES}) == len(LINES)


PAGES = sorted([*(recording.ROOT / "docs").glob("*.md"), recording.ROOT / "README.md"])


def test_cited_lines_exist():
    text = "".join(page.read_text() for page in PAGES)
    cited = set(re.findall(rf"\b(?:{'|'.join(BENCHMARKS)})-\d{{8}}T\d{{6}}\b", text))
    assert len(cited) > 10
    assert cited <= {line["id"] for _, line in LINES}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_tables_of_a_page_are_those_of_their_lines(page):
    text = page.read_text()
    assert report.TABLE.sub(report.filled, text) == text


@pytest.mark.parametrize("name", BENCHMARKS)
def test_every_benchmark_is_run_by_its_name(name):
    """As `pooliad bench` does: whether it is the long run is all that it is told."""
    (parameter,) = inspect.signature(importlib.import_module(f"benchmarks.{name}").measure).parameters.values()
    assert parameter.annotation is bool


def test_a_line_names_what_was_there_before_it_was_measured(tmp_path, monkeypatch):
    monkeypatch.setattr(recording, "RESULTS", tmp_path)
    monkeypatch.setattr(recording, "ROOT", tmp_path)
    commits = iter(["before", "after"])
    monkeypatch.setattr(recording, "_git", lambda verb, *_: next(commits) if verb == "rev-parse" else "")
    line = recording.run("speed", lambda full: {"table": []}, full=False)
    assert (line["commit"], line["uncommitted"]) == ("before", True)


def test_the_document_has_a_place_for_every_benchmark():
    named = {match.group(2) for match in report.TABLE.finditer(report.DOCUMENT.read_text())}
    assert named == set(BENCHMARKS)


def test_a_run_appends_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(recording, "RESULTS", tmp_path)
    monkeypatch.setattr(recording, "ROOT", tmp_path)
    for _ in range(2):
        recording.run("speed", lambda full: {"table": [{"what": "nothing", "full": full, "ns": 1.25}]}, full=False)
    written = [json.loads(text) for text in (tmp_path / "speed.jsonl").read_text().splitlines()]
    assert [line["tables"]["table"] for line in written] == [[{"what": "nothing", "full": False, "ns": 1.25}]] * 2
    assert "nothing    no  1.25" in capsys.readouterr().out


def test_a_table_of_the_document_is_filled_from_the_line_to_cite(monkeypatch):
    line = recording.describe("speed", full=True) | {
        "load_before": 0.1,
        "tables": {"per_event": [{"scene": "break", "pairs": 17.0, "shots": 5000}]},
    }
    monkeypatch.setattr(recording, "best_line", lambda name, title: line)
    text = report.TABLE.sub(report.filled, "<!-- table speed per_event scene shots -->\nold\n<!-- end -->")
    assert "| scene | shots |\n| --- | ---: |\n| break | 5,000 |" in text
    assert line["id"] in text
    assert "old" not in text
