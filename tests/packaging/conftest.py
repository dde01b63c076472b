"""The built wheel, installed in environments of its own outside the checkout; once a session and worker."""

import os
import subprocess
import sys
import venv
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest
from support.require import ROOT

PATIENCE = 600.0
"""Seconds one command may take: pip fetches a compiler's worth of libraries on a machine that has none."""


class Environment:
    """A virtual environment, and a directory outside the checkout to run its commands in."""

    def __init__(self, home: Path) -> None:
        venv.create(home / "venv", with_pip=True)
        self.bin = home / "venv" / "bin"
        self.cwd = home / "elsewhere"
        self.cwd.mkdir()
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "POOLIAD"))}
        path = os.pathsep.join([str(self.bin), os.environ["PATH"]])
        cache = os.environ.get("POOLIAD_CACHE_DIR", str(home / "cache"))
        self.environment: Mapping[str, str] = kept | {"PATH": path, "POOLIAD_CACHE_DIR": cache}

    def run(self, command: Sequence[str | Path], **environment: str) -> subprocess.CompletedProcess[str]:
        """Run a command by its name; what it printed and how it left."""
        return subprocess.run(
            [str(word) for word in command],
            cwd=self.cwd,
            env={**self.environment, **environment},
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=False,
        )

    def must(self, command: Sequence[str | Path], **environment: str) -> str:
        """What a command printed; it has to succeed."""
        done = self.run(command, **environment)
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
        return done.stdout


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built from the checkout."""
    out = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "build", "--wheel", "--outdir", str(out), str(ROOT)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (built,) = out.glob("pooliad-*.whl")
    return built


@pytest.fixture(scope="session")
def new_environment(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Environment]:
    """Makes an empty environment; the argument only names its directory."""
    return lambda name: Environment(tmp_path_factory.mktemp(name))


@pytest.fixture(scope="session")
def base(wheel: Path, new_environment: Callable[[str], Environment]) -> Environment:
    """The wheel without extras; what it does then is in `without_server`, for the server comes to it later."""
    made = new_environment("installed")
    made.must(["pip", "install", "--quiet", wheel])
    return made


IMPORTS = """
import importlib.util, pathlib, sys
import physics, referee, protocol, client, client.geometry
from client import Agent, AsyncPooliad, Pooliad, play, run_agent
from client.agents.greedy import GreedyAgent
server = ("fastapi", "starlette", "uvicorn", "httptools", "uvloop", "sqlalchemy", "alembic")
print([name for name in server if importlib.util.find_spec(name)])
print({pathlib.Path(module.__file__).is_relative_to(sys.prefix) for module in (physics, referee, client)})
"""
PLAY = "import client; print(client.play('random', 'random', seed=3).games[0].outcome.reason)"


@pytest.fixture(scope="session")
def without_server(base: Environment) -> dict[str, subprocess.CompletedProcess[str]]:
    """What the base install does."""
    commands = {"imports": ["python", "-c", IMPORTS], "play": ["python", "-c", PLAY]}
    commands |= {name: ["pooliad", name] for name in ("serve", "demo")}
    return {name: base.run(command) for name, command in commands.items()}


@pytest.fixture(scope="session")
def complete(wheel: Path, base: Environment, without_server: object) -> Environment:
    """The wheel with the server."""
    base.must(["pip", "install", "--quiet", f"{wheel}[server]"])
    return base
