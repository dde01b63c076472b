"""The documents' own pictures are those that the code draws."""

import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PICTURES = runpy.run_path(str(DOCS / "draw.py"))["PICTURES"]


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_as_the_code_draws_it(name):
    """To the character: a shot has the same bits on every machine. `python docs/draw.py` writes them anew."""
    assert (DOCS / "pictures" / name).read_text(encoding="utf-8") == PICTURES[name]()


def test_every_picture_is_drawn_by_the_code():
    assert {path.name for path in (DOCS / "pictures").iterdir()} == set(PICTURES)
