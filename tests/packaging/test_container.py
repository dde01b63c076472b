"""The Dockerfile does what it says: its lines are read and carried out in order, then its command serves.

In a copy of the checkout and a fresh environment: paths of the image become paths of the copy, its user the one who
runs the test, its port a free one.
"""

import json
import os
import platform
import re
import shlex
import shutil
import socket
import subprocess
import time
import tomllib
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from docker.utils.build import exclude_paths
from support.require import ROOT, require

TEXT = re.sub(r"\\\n\s*", "", (ROOT / "Dockerfile").read_text(encoding="utf-8"))
INSTRUCTIONS = re.findall(r"^([A-Z]+) (.+)$", TEXT, re.MULTILINE)
STARTS_WITHIN = 60.0
"""Seconds; a warm server needs one or two, more on a loaded machine."""


def only(instruction: str) -> str:
    """The argument of an instruction that stands there once."""
    (rest,) = [rest for name, rest in INSTRUCTIONS if name == instruction]
    return rest


def context_files(source: str = ".") -> list[str]:
    """The files of the build context at or below a path, by Docker's own rules for `.dockerignore`."""
    patterns = (ROOT / ".dockerignore").read_text(encoding="utf-8").splitlines()
    there = exclude_paths(str(ROOT), patterns)
    below = "" if source == "." else f"{source}/"
    files = [name for name in there if (ROOT / name).is_file() and not (ROOT / name).is_symlink()]
    return sorted(name for name in files if name == source or name.startswith(below))


def tracked_files(source: str) -> list[str]:
    """The files of the checkout at or below a path."""
    command = ["git", "-c", f"safe.directory={ROOT}", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"]
    done = subprocess.run([*command, "--", source], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return sorted(name for name in done.stdout.splitlines() if (ROOT / name).exists())
    files = [path for path in [ROOT / source, *(ROOT / source).rglob("*")] if path.is_file()]  # no checkout: a copy
    return sorted(str(path.relative_to(ROOT)) for path in files if "__pycache__" not in path.parts)


class Image:
    """The image's file system in a directory, its Python a fresh environment."""

    def __init__(self, root: Path, python: Any) -> None:
        self.root = root
        self.python = python
        self.variables: dict[str, str] = {}
        self.directory = root

    def here(self, text: str) -> str:
        """The text with the image's paths and user become ours."""
        user, _, group = only("USER").partition(":")
        text = text.replace(f"-o {user} -g {group}", f"-o {os.getuid()} -g {os.getgid()}")
        return re.sub(r"/(source|wheels|data|var/cache)\b", lambda path: f"{self.root}{path[0]}", text)

    def build(self) -> None:
        """Every instruction in order."""
        for name, rest in INSTRUCTIONS:
            if name == "ENV":
                self.variables |= dict(self.here(word).split("=", 1) for word in shlex.split(rest))
                self.variables.pop("PIP_NO_CACHE_DIR", None)  # pip may use the cache of this machine
            elif name == "WORKDIR":
                self.directory = Path(self.here(rest))
                self.directory.mkdir(parents=True, exist_ok=True)
            elif name == "COPY":
                self.copy(rest)
            elif name == "RUN":
                self.python.must(["bash", "-euc", f"cd {self.directory}; {self.here(rest)}"], **self.variables)

    def copy(self, rest: str) -> None:
        """COPY from the build context, or from the stage before, whose file system is the same here."""
        *sources, target = rest.removeprefix("--from=build ").split()
        if rest.startswith("--from=build "):
            here, there = Path(self.here(sources[0])), Path(self.here(target))
            if here.is_file():
                there.parent.mkdir(exist_ok=True)
                shutil.copy(here, there)
            return
        for source in sources:
            for name in context_files(source):
                place = self.directory / target / Path(name).relative_to(source if (ROOT / source).is_dir() else ".")
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, place)

    def compiled(self) -> dict[str, float]:
        """The files of the kernel cache, each with its time of writing."""
        cache = Path(self.variables["POOLIAD_CACHE_DIR"])
        return {str(path): path.stat().st_mtime for path in cache.rglob("*.nb*")}


@pytest.fixture(scope="module")
def image(new_environment: Any, tmp_path_factory: pytest.TempPathFactory) -> Image:
    """The image, built."""
    require(platform.machine() == "x86_64", "an x86-64 processor, which the image is for")
    made = Image(tmp_path_factory.mktemp("image"), new_environment("container"))
    made.build()
    return made


@pytest.fixture(scope="module")
def url(image: Image) -> Iterator[str]:
    """The address of the image's command, running in its last directory."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [word.replace("8080", str(port)) for word in json.loads(only("CMD"))]
    command[0] = str(image.python.bin / command[0])
    environment = image.python.environment | image.variables
    with subprocess.Popen(command, cwd=image.directory, env=environment, stdout=subprocess.DEVNULL) as process:
        try:
            yield f"http://127.0.0.1:{port}"
        finally:
            process.terminate()


def ask(url: str, body: object = None, token: str = "") -> Any:
    """The JSON answer of an address, asked until the server is up."""
    deadline = time.monotonic() + STARTS_WITHIN
    data = None if body is None else json.dumps(body).encode()
    headers = {"Content-Type": "application/json"} | ({"Authorization": f"Bearer {token}"} if token else {})
    while True:
        try:
            request = urllib.request.Request(url, data, headers)
            with urllib.request.urlopen(request, timeout=10) as answer:
                return json.load(answer)
        except OSError as error:
            if isinstance(error, urllib.error.HTTPError) and error.code != 503:
                raise
            if time.monotonic() > deadline:
                pytest.fail(f"{url}: {error}")
            time.sleep(0.1)


def test_it_is_slim_and_does_not_run_as_root():
    (base,) = {rest.split()[0] for name, rest in INSTRUCTIONS if name == "FROM"}
    assert re.fullmatch(r"python:3\.\d+\.\d+-slim-[a-z]+", base), "a version, not what it is today"
    assert int(only("USER").partition(":")[0]) > 0
    names = [name for name, _ in INSTRUCTIONS]
    assert names.index("USER") < names.index("CMD")


def test_the_build_context_has_what_every_copy_needs():
    """Seen: `.dockerignore` left out tournament/, and no image could be built."""
    copies = [rest.split()[:-1] for name, rest in INSTRUCTIONS if name == "COPY" and not rest.startswith("--from")]
    sources = [source for words in copies for source in words]
    assert {"pyproject.toml", "locks"} <= set(sources)
    for source in sources:
        needed = tracked_files(source)
        assert needed, f"COPY {source}: there is no such file"
        assert context_files(source) == needed
    packages = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]["build"]["targets"]["wheel"]
    assert set(packages["packages"]) <= set(sources), "what the wheel is made of is copied"


def test_the_build_context_has_nothing_else():
    """No token, no database and no environment that lies in the checkout gets into an image."""
    copied = {source for name, rest in INSTRUCTIONS if name == "COPY" for source in rest.split()[:-1]}
    docker_needs = {"Dockerfile", ".dockerignore"}
    assert {name.partition("/")[0] for name in context_files()} - docker_needs <= copied


def test_the_image_installs_from_the_lock_alone():
    installs = [rest for name, rest in INSTRUCTIONS if name == "RUN" and "pip " in rest]
    assert len(installs) == 4
    for command in installs:
        assert "--require-hashes" in command or "--no-deps" in command, command
    assert not [rest for rest in installs if "pip wheel" in rest and "--no-build-isolation" not in rest]


@pytest.mark.slow
def test_the_health_check_answers(image, url):
    assert ask(f"{url}/healthz") == {"status": "ok"}
    check = json.loads(only("HEALTHCHECK").partition("CMD ")[2])
    check = [word.replace("http://127.0.0.1:8080", url) for word in check]
    image.python.must(check)
    assert image.python.run([word.replace("healthz", "nothing") for word in check]).returncode != 0


@pytest.mark.slow
def test_the_server_compiles_nothing_any_more(image, url):
    """The cache was warmed at build; every way into the kernels finds it."""
    before = image.compiled()
    assert before
    assert ask(f"{url}/readyz")["status"] == "ready"
    balls, shot = {"0": [0.5, 1.7], "3": [0.4, 0.6]}, {"v": 2.0, "phi": 260.0, "theta": 10.0, "a": 0.0, "b": 0.0}
    token = ask(f"{url}/v1/agents", {"name": "reader"})["token"]
    ask(f"{url}/v1/simulate", {"balls": balls, "shot": shot}, token)
    ask(f"{url}/v1/simulate/batch", {"balls": balls, "shots": [shot, shot]}, token)
    ask(f"{url}/v1/simulate/batch", {"tables": [balls], "shots": [shot]}, token)
    ask(f"{url}/v1/min-elevation", {"balls": balls, "phi": 260.0}, token)
    assert image.compiled() == before


@pytest.mark.slow
def test_the_kernels_are_for_no_processor_in_particular(image):
    """Built on one machine, the image runs on another: numba looks its cache up by processor and features."""
    indices = [Path(name) for name in image.compiled() if name.endswith(".nbi")]
    assert indices
    for index in indices:
        content = index.read_bytes()
        assert b"x86-64-v3" in content
        assert b"+avx" not in content


@pytest.mark.slow
def test_games_are_kept_in_the_volume(image, url):
    ask(f"{url}/readyz")
    assert only("VOLUME") == "/data"
    assert (image.root / "data" / "pooliad.db").is_file()
