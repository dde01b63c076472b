"""Policy of the whole test suite: helpers in ``support`` are importable, which absences may be skipped, hypothesis."""

import os
import subprocess
import sys
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

sys.path.insert(0, str(Path(__file__).parent))

settings.register_profile("pooliad", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("pooliad")


KERNELS = ("from physics.engine import kernels; kernels()", "from physics.engine import kernels; kernels(jaws=True)")


def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile the kernels once, both sets at a time, before tests and workers that would all wait for them."""
    if not hasattr(session.config, "workerinput") and not session.config.option.collectonly:
        for compiler in [subprocess.Popen([sys.executable, "-c", program]) for program in KERNELS]:
            compiler.wait()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, Any]:
    """With POOLIAD_REQUIRE=all a skipped test is a failed one: everything it needs must be there."""
    report = yield
    if report.skipped and not hasattr(report, "wasxfail") and os.environ.get("POOLIAD_REQUIRE") == "all":
        report.outcome = "failed"
        report.longrepr = f"{item.nodeid} skipped although POOLIAD_REQUIRE=all: {report.longrepr}"
    return report


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Say how many of the drawn scenes were special ones."""
    scenes = sys.modules.get("support.scenes")
    if scenes and scenes.TALLY:
        total = scenes.TALLY.total()
        parts = ", ".join(f"{kind} {count} ({count / total:.0%})" for kind, count in sorted(scenes.TALLY.items()))
        terminalreporter.write_line(f"scenes drawn by the physics properties: {total}: {parts}")
