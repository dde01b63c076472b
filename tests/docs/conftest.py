"""A real server for the pages that talk to one, and a shell to run their commands in."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest
from support.require import require

from client.cli import embedded
from client.cli.processes import children
from client.cli.serve import NEEDED


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[embedded.Embedded]:
    """A server for the whole session."""
    for name in NEEDED:
        require(find_spec(name) is not None, f"{name}, of the server extra")
    with children() as started:
        yield embedded.start(started, tmp_path_factory.mktemp("documents"))


@pytest.fixture
def shell(tmp_path: Path) -> Callable[..., str]:
    """Runs a block as a reader's bash would, in a directory of its own, `pooliad` on the path."""

    def run(block: str, **environment: str) -> str:
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", block],
            cwd=tmp_path,
            env=os.environ | {"PATH": path} | environment,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return run
