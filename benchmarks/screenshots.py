"""Makes the README's pictures of the page: ``python -m benchmarks.screenshots`` writes ``docs/page_*.png``.

A record of a local game and the laboratory, before a real server, in Debian's Chromium (needs the test extra). A test
makes them again and compares, coarsely: letters are drawn otherwise elsewhere, and the spread of noise is drawn by lot.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import client
from benchmarks.recording import ROOT

PICTURES = ROOT / "docs"
SIZE = {"width": 1100, "height": 720}
POSITION = "0:0.5,1.7 3:0.4,0.6 8:0.7,0.9 11:0.2,1.3 14:0.95,0.35"
PATIENCE = 600_000
"""Milliseconds: a server without compiled kernels compiles them first."""
SEEK = "(slider, part) => { slider.value = part * slider.max; slider.dispatchEvent(new Event('input')); }"


@contextmanager
def running(folder: Path) -> Iterator[tuple[str, "subprocess.Popen[str]"]]:
    """A server with a fresh database: its address and its process, which ends with the block."""
    command = [sys.executable, "-m", "server", "--port", "0", "--database", f"sqlite:///{folder / 'pooliad.db'}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield str(json.loads(process.stdout.readline())["url"]), process
        finally:
            process.terminate()


@contextmanager
def browser() -> Iterator[Any]:
    """Chromium, without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=sandbox)
        yield chromium
        chromium.close()


def record(folder: Path) -> Path:
    """A game of two shipped agents."""
    (game,) = client.play("greedy", "greedy", games=1, seed=5).games
    file = folder / "record.jsonl"
    file.write_text("".join(f"{line}\n" for line in game.record()))
    return file


def game_picture(page: Any, url: str, file: Path, folder: Path) -> None:
    """The break, a moment after the rack has opened."""
    page.goto(url)
    page.get_by_label("Look at a record").set_input_files(file)
    page.locator("ul.rules li").first.wait_for()
    page.get_by_label("Time of the stroke").evaluate(SEEK, 0.12)
    page.screenshot(path=folder / "page_game.png")


def laboratory_picture(page: Any, url: str, folder: Path) -> None:
    """A shot, its paths, and where noise lets the balls rest."""
    page.goto(f"{url}/#/lab")
    page.get_by_label("Text", exact=True).fill(POSITION)
    page.get_by_role("button", name="Set up from the notation").click()
    for label, value in (("Direction, degrees", "264.9"), ("Cue speed, m/s", "2.6")):
        page.get_by_label(label, exact=True).fill(value)
        page.get_by_label(label, exact=True).press("Tab")
    page.locator(".outcome:not([aria-busy])", has_text="events in").wait_for()
    page.get_by_role("button", name="Play it 200 times").click()
    page.locator("p.facts", has_text="ocket").wait_for()
    page.evaluate("scrollTo(0, 0)")
    page.screenshot(path=folder / "page_laboratory.png")


def main(folder: Path = PICTURES) -> None:
    """Both pictures."""
    with tempfile.TemporaryDirectory() as name, running(Path(name)) as (url, _), browser() as chromium:
        page = chromium.new_page(viewport=SIZE)
        page.set_default_timeout(PATIENCE)
        game_picture(page, url, record(Path(name)), folder)
        laboratory_picture(page, url, folder)


if __name__ == "__main__":
    main()
