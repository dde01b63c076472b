"""`pooliad bench` starts `benchmarks` as a program, from wherever the user stands."""

import importlib
import json
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import client
from benchmarks import __main__ as program
from benchmarks import recording
from benchmarks.catalogue import BENCHMARKS


def bench(*arguments, cwd):
    """The command, as a user runs it."""
    command = [sys.executable, "-P", "-m", "client.cli", "bench", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, check=False)


def test_it_lists_the_benchmarks_of_the_checkout_and_of_nothing_else(tmp_path):
    """A folder of the same name where the user stands is not taken for them."""
    (tmp_path / "benchmarks").mkdir()
    (tmp_path / "benchmarks" / "__main__.py").write_text("raise SystemExit('not these')")
    done = bench("--json", cwd=tmp_path)
    assert (done.returncode, json.loads(done.stdout)) == (0, BENCHMARKS), done.stderr
    assert [line.split()[0] for line in bench(cwd=tmp_path).stdout.splitlines()] == list(BENCHMARKS)


def test_an_unknown_benchmark_is_wrong_usage(tmp_path):
    done = bench("--full", "none", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert "there is no benchmark 'none'; there are speed, " in done.stderr


@pytest.mark.parametrize(("failures", "code"), [([], 0), ([{"shot": 1}], 1)])
def test_the_line_is_printed_and_failures_are_an_exit_code(monkeypatch, capsys, failures, code):
    appended: list[Any] = []
    measure = SimpleNamespace(measure=lambda full: {"rows": [{"full": full}], "failures": failures})
    monkeypatch.setattr(importlib, "import_module", lambda name: {"benchmarks.speed": measure}[name])
    monkeypatch.setattr(recording, "append", appended.append)
    assert program.main(["speed", "--full", "--json"]) == code
    told = capsys.readouterr()
    assert json.loads(told.out) == appended[0]
    assert appended[0]["tables"]["rows"] == [{"full": True}]
    assert ("1 failures" in told.err) is bool(failures)


def test_the_client_does_not_import_the_benchmarks():
    """They lie above it: `client` starts them, and imports nothing of theirs."""
    texts = [path.read_text(encoding="utf-8") for path in Path(client.__file__).parent.rglob("*.py")]
    assert [text for text in texts if "import benchmarks" in text or "from benchmarks" in text] == []
