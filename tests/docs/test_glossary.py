"""docs/glossary.md: one word, one meaning. A public class name stands in one place, or in those the glossary names."""

import ast
import re
from collections import defaultdict

from support.documents import PAGES
from support.require import ROOT

PACKAGES = ("physics", "pictures", "calibration", "referee", "tournament", "protocol", "server", "client")
MIRRORED = re.compile(r"^(client|server)/errors")
"""A problem code has two classes of one name: the server answers with the one, the client raises the other."""


def class_homes():
    homes = defaultdict(set)
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            for node in ast.parse(path.read_text(encoding="utf-8")).body:
                if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                    homes[node.name].add(path.relative_to(ROOT).as_posix())
    return homes


def homes_in_glossary():
    text = PAGES["docs/glossary.md"].read_text(encoding="utf-8").split("## Words with two homes")[1]
    rows = re.findall(r"^\| `(\w+)` \| (.+?) \| .+ \|$", text, re.MULTILINE)
    return {name: set(re.findall(r"`([\w/.]+)`", homes)) for name, homes in rows}


def test_a_class_name_has_one_home_or_stands_in_the_glossary():
    several = {name: places for name, places in class_homes().items() if len(places) > 1}
    mirrored = {name for name, places in several.items() if all(MIRRORED.match(place) for place in places)}
    assert {name: places for name, places in several.items() if name not in mirrored} == homes_in_glossary()


def test_every_word_stands_once():
    words = re.findall(r"^\| ([a-z][\w ,'-]*) \| ", PAGES["docs/glossary.md"].read_text(encoding="utf-8"), re.MULTILINE)
    single = [word for entry in words if entry != "word" for word in entry.split(", ")]
    assert len(single) == len(set(single)) > 80
