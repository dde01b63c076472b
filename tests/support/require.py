"""What a test needs from outside the repository; absent, the test is skipped with the reason.

With ``POOLIAD_REQUIRE=all`` such a skip is a failure (``tests/conftest.py``).
"""

import json
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data"


def require(present: bool, component: str) -> None:
    """Skip the running test unless the named component is present."""
    if not present:
        pytest.skip(f"needs {component}")


def reference_data(name: str) -> Path:
    """A file of measured reference data kept beside the checkout."""
    path = DATA / name
    require(path.is_file(), f"reference data {path}")
    return path


def reference_shots() -> list[dict[str, Any]]:
    """The 332 shots of the historical engine."""
    return [json.loads(line) for line in reference_data("fastfiz_shots.jsonl").read_text().splitlines()]


def reference_quartics() -> list[dict[str, Any]]:
    """The 3,000 contact quartics with exact answers."""
    return list(json.loads(reference_data("quartics.json").read_text())["quartics"])
