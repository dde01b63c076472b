"""The digest of an engine: what its sources say, not how they look, where they lie, or which Python reads them."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.pythons import python
from support.require import ROOT

from referee.record import this_engine
from referee.record.engine import deciding_sources
from referee.record.sources import digest_of_sources

SAMPLE = {
    "sample": Path(__file__).with_name("digest_sample.txt").read_bytes(),
    "sample.part": b"half = lambda x: x / 2\nthird = lambda x: x / 3\n",
}
DIGEST = "0439fedf1c6aeef64e4c1837eb427480cfc2bd450770c24410b170ba3245ebfb"
"""Of the sample, made with Python 3.11.7, 3.12.1 and 3.13.0, which agree: every version that runs these tests must."""

READ = """
import importlib.util, json, sys
spec = importlib.util.spec_from_file_location("sources", sys.argv[1])
sources = sys.modules["sources"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sources)
for files in json.load(sys.stdin):
    print(sources.digest_of_sources({name: text.encode() for name, text in files.items()}))
"""


def test_the_digest_of_the_sample_is_the_one_that_is_written_down():
    """On whatever version runs the tests."""
    assert digest_of_sources(SAMPLE) == DIGEST, sys.version


@pytest.mark.parametrize("version", ["3.11", "3.12", "3.13"])
def test_every_version_of_python_reads_the_same(version):
    """The sample, and the engine itself; a version that is not on the machine is a test skipped by name."""
    files = [{name: source.decode() for name, source in sources.items()} for sources in (SAMPLE, deciding_sources())]
    command = [python(version), "-I", "-c", READ, str(ROOT / "referee" / "record" / "sources.py")]
    done = subprocess.run(command, input=json.dumps(files), capture_output=True, text=True, check=True)
    assert done.stdout.split() == [DIGEST, this_engine().digest]


def one(text):
    """The digest of a file of its own."""
    return digest_of_sources({"m": text.encode()})


BASE = """
def pot(x, y):
    if x:
        return f"{x} balls", (y + 1)
    return None
"""


@pytest.mark.parametrize(
    "text",
    [
        f'"""Docstring."""\n{BASE}# comment\n',
        BASE.replace("(x, y):", '(x, y):\n    """Docstring."""\n'),
        BASE.replace("    if x:", "    # why\n\n    if x:  # when"),
        BASE.replace("    ", "\t"),
        BASE.replace("\n", "\r\n"),
        BASE.replace("(x, y)", "(\n        x,\n        y,\n    )"),
        BASE.replace('"', "'"),
        BASE.replace("(y + 1)", "y + 1"),
        BASE.replace("y + 1", "y + \\\n 1"),
        BASE.replace('f"{x} balls"', 'f"{x}" " bal" "ls"'),
        f'__all__ = ["pot"]\n{BASE}',
    ],
    ids=["docstring", "inner docstring", "comment", "tabs", "line ends", "layout", "quotes", "parentheses",
         "continuation", "pieces of a text", "list of exports"],
)  # fmt: skip
def test_what_a_source_looks_like_does_not_matter(text):
    assert one(text) == one(BASE)


@pytest.mark.parametrize(
    ("old", "new"),
    [("1", "1.0"), ("1", "2"), ("1", "True"), ("+", "-"), ("x, y", "y, x"), ("if x", "if y"), ("pot", "pod"),
     (" balls", " ball"), ('f"{x}', 'f"{x!r}'), ('f"', '"'), ("None", "...") , ("(y + 1)", "(y + 1,)"),
     ("return None", "yield None"), ("def pot", "@cache\ndef pot"), ("y)", "y=None)"), ("y)", "*y)"),
     ("y)", "y: int)")],
)  # fmt: skip
def test_what_a_source_says_does(old, new):
    assert old in BASE
    assert one(BASE.replace(old, new)) != one(BASE)


HERE = {
    "game": b"from game.balls import radius\nfrom game.rules import foul\n",
    "game.balls": b"def radius():\n    return 1\n",
    "game.cloth": b"def radius():\n    return 2\n",
    "game.rules": b"import math\nfrom game.balls import radius\nfrom game import cloth\n"
    b"def foul(x):\n    return x < radius() + cloth.radius() * math.pi\n",
}


def test_files_may_be_moved_and_names_passed_on_by_packages():
    moved = {
        "game": b"from game.things import radius\nfrom game.law.rules import foul\n",
        "game.law": b'"""Rules."""\nfrom game.law.rules import foul\n',
        "game.things": b"from game.things.balls import radius\n__all__ = ['radius']\n",
        "game.things.balls": HERE["game.balls"],
        "game.things.cloth": HERE["game.cloth"],
        "game.law.rules": HERE["game.rules"]
        .replace(b"game.balls", b"game.things")
        .replace(b"from game import cloth", b"from game.things import cloth"),
    }
    assert digest_of_sources(moved) == digest_of_sources(HERE)


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("game.rules", b"from game.balls import radius", b"from game.cloth import radius"),
        ("game.rules", b"from game import cloth", b"from game import balls as cloth"),
        ("game.rules", b"import math", b"import cmath as math"),
        ("game.balls", b"return 1", b"return 3"),
    ],
    ids=["a function of the same name", "a file of the same name", "a library", "what is imported"],
)
def test_what_is_imported_matters(file, old, new):
    assert old in HERE[file]
    assert digest_of_sources(HERE | {file: HERE[file].replace(old, new)}) != digest_of_sources(HERE)


def test_files_that_exchange_what_they_say_are_another_engine():
    """All files say what they said; who imports what does not."""
    exchanged = HERE | {"game.balls": HERE["game.cloth"], "game.cloth": HERE["game.balls"]}
    assert digest_of_sources(exchanged) != digest_of_sources(HERE)


def test_a_file_more_or_less_is_another_engine():
    assert digest_of_sources(HERE | {"game.more": b"x = 1\n"}) != digest_of_sources(HERE)
    assert digest_of_sources({name: HERE[name] for name in list(HERE)[1:3]}) != digest_of_sources(HERE)


def test_the_engine_covers_physics_rules_and_stroke():
    modules = set(deciding_sources())
    assert {"physics.table", "physics.kernels.loop", "referee.rules.judge", "referee.play.stroke"} <= modules
    sources = deciding_sources()
    loop = sources["physics.kernels.loop"]
    assert digest_of_sources(sources | {"physics.kernels.loop": loop + b"# why\n"}) == this_engine().digest
    assert digest_of_sources(sources | {"physics.kernels.loop": loop + b"x = 1\n"}) != this_engine().digest


def test_no_docstring_decides_anything():
    """The digest leaves them out: code that reads one would be changed by it unseen."""
    for name, source in deciding_sources().items():
        for node in ast.walk(ast.parse(source)):
            read = getattr(node, "id", None) or getattr(node, "attr", None)
            assert read not in ("__doc__", "getdoc", "getsource"), f"{name}: {ast.unparse(node)}"
