"""Every Python block of README and docs/ runs, one namespace a page; every link leads somewhere."""

import pkgutil
import re
from pathlib import Path

import pytest
from support.documents import PAGES, python_blocks
from support.require import ROOT

LANGUAGES = {"python", "bash", "text"}
"""Python runs, bash runs, text does not."""


@pytest.mark.parametrize("page", PAGES)
def test_python_blocks_run_in_order(page):
    for block in python_blocks(PAGES[page]):
        block.evaluate()


@pytest.mark.parametrize("page", PAGES)
def test_every_block_says_what_it_is(page):
    fences = re.findall(r"^```(.*)$", PAGES[page].read_text(encoding="utf-8"), re.MULTILINE)
    assert set(fences[::2]) <= LANGUAGES
    assert set(fences[1::2]) <= {""}


@pytest.mark.parametrize("page", PAGES)
def test_links_and_named_files_exist(page):
    """Links of Markdown, and whatever in backquotes looks like a file of the repository; NAME stands for any."""
    text = PAGES[page].read_text(encoding="utf-8")
    links = [link for link in re.findall(r"\]\(([^)#]+)", text) if "://" not in link]
    assert [link for link in links if not (PAGES[page].parent / link).exists()] == []
    folders = "|".join(path.name for path in ROOT.iterdir() if path.is_dir() and not path.name.startswith("."))
    named = re.findall(rf"`((?:{folders})/[\w./-]*)`", text)
    assert [name for name in named if not any(ROOT.glob(name.rstrip("/").replace("NAME", "*")))] == []


def test_every_page_is_in_the_index_and_ends_with_limits():
    index = (ROOT / "README.md").read_text(encoding="utf-8")
    for page in sorted(Path("docs") / path.name for path in PAGES.values() if path.parent.name == "docs"):
        assert f"]({page})" in index, f"{page} is not in the README's index"
        headings = re.findall(r"^## (.+)$", (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE)
        assert headings[-1] == "Limits", f"{page} ends with {headings[-1]!r}"


@pytest.mark.parametrize("page", PAGES)
def test_full_names_lead_somewhere(page):
    """`package.module.name` in backquotes is a module, a function, a class or something of one."""
    text = PAGES[page].read_text(encoding="utf-8")
    for name in sorted(
        set(re.findall(r"`((?:physics|calibration|referee|tournament|protocol|server|client)(?:\.\w+)+)", text))
    ):
        pkgutil.resolve_name(name)
