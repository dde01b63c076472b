"""Benchmarks as data (issue "exact, fast, never wrong"): lines are complete, and documents cite lines that exist."""

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


@pytest.mark.parametrize("page", ["benchmarks.md", "physics.md", "agents.md", "../README.md"])
def test_a_cited_line_exists(page):
    path = recording.ROOT / "docs" / page
    text = path.read_text() if path.exists() else ""
    cited = set(re.findall(rf"\b(?:{'|'.join(BENCHMARKS)})-\d{{8}}T\d{{6}}\b", text))
    assert cited <= {line["id"] for _, line in LINES}


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
    monkeypatch.setattr(recording, "best_line", lambda name: line)
    text = report.TABLE.sub(report.filled, "<!-- table speed per_event scene shots -->\nold\n<!-- end -->")
    assert "| scene | shots |\n| --- | ---: |\n| break | 5,000 |" in text
    assert line["id"] in text
    assert "old" not in text
