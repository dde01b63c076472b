"""The same bits everywhere: recorded hashes, compiled or interpreted, and on every instruction level of the host.

``shots.txt`` holds a SHA-256 of the trace and the end of each scene of ``support/bits.py``. A deliberate change of the
physics renews it: ``PYTHONPATH=tests python -m support.bits > tests/golden/shots.txt``.
"""

import os
import platform
import subprocess
import sys
from pathlib import Path

import pytest
from support.bits import digest, plays
from support.require import ROOT, require


def by_name(text):
    """The hash of each scene, from lines of a hash and a name."""
    return {name: digest for digest, name in (line.split("  ", 1) for line in text.splitlines())}


GOLDEN = by_name(Path(__file__).with_name("shots.txt").read_text())
PLAYS = {play[0]: play for play in plays()}


def in_another_process(**environment: str) -> dict[str, str]:
    """The hashes a fresh process with these settings computes."""
    settings = {**os.environ, "PYTHONPATH": f"{ROOT / 'tests'}{os.pathsep}{ROOT}", **environment}
    done = subprocess.run(
        [sys.executable, "-m", "support.bits"], env=settings, capture_output=True, text=True, check=True, cwd=ROOT
    )
    return by_name(done.stdout)


def test_every_scene_is_recorded():
    assert set(GOLDEN) == set(PLAYS)


@pytest.mark.parametrize("name", PLAYS)
def test_recorded_bits(name):
    assert digest(PLAYS[name]) == GOLDEN[name]


def test_interpreted_bits():
    assert in_another_process(NUMBA_DISABLE_JIT="1") == GOLDEN


def test_bits_of_the_oldest_processor():
    """x86-64 without extensions (SSE2), the furthest from this processor's own instructions."""
    require(platform.machine() in {"x86_64", "AMD64"}, "an x86-64 processor")
    assert in_another_process(NUMBA_CPU_NAME="x86-64", NUMBA_CPU_FEATURES="") == GOLDEN


@pytest.mark.long
@pytest.mark.parametrize("level", ["generic", "x86-64-v2", "x86-64-v3", "x86-64-v4"])
def test_bits_of_other_processors(level):
    require(platform.machine() in {"x86_64", "AMD64"}, "an x86-64 processor")
    flags = Path("/proc/cpuinfo").read_text().split() if Path("/proc/cpuinfo").exists() else []
    needs = {"x86-64-v3": "avx2", "x86-64-v4": "avx512vl"}.get(level)
    require(needs is None or needs in flags, f"a processor with {needs}")
    assert in_another_process(NUMBA_CPU_NAME=level, NUMBA_CPU_FEATURES="") == GOLDEN
