"""locks/: what CI and the image install, by hash. Written by `.ci/lock`; here compared with pyproject.toml, offline."""

import re
import tomllib
from importlib import metadata
from itertools import chain

import pytest
from packaging.markers import Marker, default_environment
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from support.require import ROOT

PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
WANTED = {"build": (), "server": ("server",), "test": ("test",)}
"""The locks, each with the extras of this project that it holds."""
PIN = re.compile(r"(?P<name>[a-z0-9][a-z0-9.-]*)==(?P<version>[^ ;]+)(?: ; (?P<marker>.+))?")
HASH = re.compile(r"--hash=sha256:[0-9a-f]{64}")


def text_of(name):
    return (ROOT / "locks" / f"{name}.txt").read_text(encoding="utf-8")


def entries(name):
    """The lines of a lock with what continues them, comments left out."""
    text = re.sub(r"^#.*\n", "", text_of(name), flags=re.MULTILINE)
    return [line.split() for line in re.sub(r" \\\n +", " ", text).splitlines()]


def pins(name):
    """Each locked distribution with its version and marker; of several versions of one, that for this Python."""
    found = [PIN.fullmatch(" ".join(word for word in words if not HASH.fullmatch(word))) for words in entries(name)]
    assert all(found), "every line is NAME==VERSION, a marker and hashes"
    here_last = sorted(found, key=lambda match: applies(match["marker"] and Marker(match["marker"])))
    return {match["name"]: (match["version"], match["marker"]) for match in here_last}


def applies(marker, extra=""):
    return marker is None or marker.evaluate(default_environment() | {"extra": extra})


def own_requirements(lock):
    """What pyproject.toml asks for directly."""
    project = PYPROJECT["project"]
    if lock == "build":
        return [*PYPROJECT["dependency-groups"]["build"], *PYPROJECT["build-system"]["requires"]]
    optional = project["optional-dependencies"]
    asked, extras = list(project["dependencies"]), list(WANTED[lock])
    while extras:
        for text in optional[extras.pop()]:
            requirement = Requirement(text)
            if requirement.name == project["name"]:
                extras += requirement.extras
            else:
                asked.append(text)
    return asked + (own_requirements("build") if lock == "test" else [])


def is_installed_as(locked, name):
    """Whether the distribution is here in its locked version; another may have other requirements.

    The README's block installs without the locks: what only builds need, such as hatchling, is then not here at all.
    """
    try:
        return metadata.version(name) == locked[canonicalize_name(name)][0]
    except metadata.PackageNotFoundError:
        return False


def closure(lock):
    """Every requirement that follows from pyproject.toml here, as far as distributions are installed as locked."""
    locked = pins(lock)
    waiting = [Requirement(text) for text in own_requirements(lock)]
    seen = set()
    while waiting:
        requirement = waiting.pop()
        key = canonicalize_name(requirement.name), frozenset(requirement.extras)
        yield requirement
        if key in seen or key[0] not in locked or not is_installed_as(locked, requirement.name):
            continue
        seen.add(key)
        for text in metadata.requires(requirement.name) or ():
            following = Requirement(text)
            if any(applies(following.marker, extra) for extra in ("", *requirement.extras)):
                waiting.append(following)


@pytest.mark.parametrize("lock", WANTED)
def test_a_lock_is_what_pyproject_allows(lock):
    """Stale: a range that the locked version is not in, a requirement that is not locked, one that nothing asks for."""
    locked = pins(lock)
    needed = set()
    for requirement in closure(lock):
        name = canonicalize_name(requirement.name)
        assert name in locked, f"{requirement} is not in locks/{lock}.txt: run .ci/lock"
        assert requirement.specifier.contains(locked[name][0], prereleases=True), f"{requirement}: run .ci/lock"
        needed.add(name)
    here = {name for name, (_, marker) in locked.items() if applies(marker and Marker(marker))}
    assert needed <= here, f"locks/{lock}.txt: run .ci/lock"
    if all(is_installed_as(locked, name) for name in here):
        assert needed == here, f"locks/{lock}.txt: run .ci/lock"


@pytest.mark.parametrize("lock", WANTED)
def test_everything_is_pinned_by_hash_and_nothing_names_an_index(lock):
    assert pins(lock)
    for words in entries(lock):
        assert any(HASH.fullmatch(word) for word in words), words[0]
    assert not re.search(r"https?:|file:|--index|--extra-index|--find-links|--trusted|@", text_of(lock))


def test_the_locks_agree():
    """CI tests what the image runs."""
    versions: dict[str, str] = {}
    for name, (version, _) in chain.from_iterable(pins(lock).items() for lock in WANTED):
        assert versions.setdefault(name, version) == version, name
    assert set(pins("server")) | set(pins("build")) <= set(pins("test"))


def test_ci_installs_from_the_lock():
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    assert "--require-hashes -r locks/test.txt" in script
