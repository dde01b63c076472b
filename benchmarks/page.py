"""The page with 30 live games: what it takes of a processor, what the server takes beside it, its longest frame.

And how soon the page of a game shows its table.

A real server, strokes of simple players over HTTP at a steady rate, Chromium without a window and without a graphics
card. The browser's time is that of all its processes. It is measured first with the page alone, then frames are
timed, from one to the next as the page is told of them: asking for every frame costs time of its own.

A page that is opened for the first time loads everything. Its first picture is the first in which players are named and
the balls lie where they do, the server's drawing or the script's. The time is that from the navigation's start to the
frame after it, or to the browser's own first contentful paint (w3.org/TR/paint-timing) where that is later; until the
game is live, it is that to the frame after the script's first drawing.

Takes a minute, or two in a full run, whatever the machine: what cannot be played in time is not played.
"""

import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx2

from benchmarks.command import main
from benchmarks.page_games import GAMES, ORGANISER, Games
from benchmarks.recording import Row, Tables
from benchmarks.screenshots import browser, running

SHORT, FULL = 8.0, 40.0
"""Seconds of each of the two measurements."""
WARM_UP = 8.0
READY_WITHIN = 300.0
"""Seconds for the kernels, which are compiled once a change; they are loaded in one or two."""
SETTINGS = {
    "POOLIAD_ORGANISER_TOKEN": ORGANISER,
    "POOLIAD_LOG_LEVEL": "error",
    "POOLIAD_NO_SHOW_SECONDS": "86400",
}
OPENINGS, FEW_OPENINGS = 40, 10
ADDRESSES = ("/games/", "/#/games/")
"""Of a game: its own, and the one within the page that it had in 0.1.0, of which the server learns nothing."""
WATCH_TABLE = """
  const isLarge = (one) => one.getBoundingClientRect().height > 0;
  const look = () => {
    const named = document.querySelector("h1")?.textContent.includes("–");
    const live = named && document.querySelector(".table canvas")?.style.width;
    const drawn = named && [...document.querySelectorAll(".first-picture svg")].some(isLarge);
    if ((live || drawn) && !window.asked) {
      window.asked = true;
      requestAnimationFrame(() => { window.table_seen = performance.now(); });
    }
    requestAnimationFrame(live ? () => { window.live_seen = performance.now(); } : look);
  };
  requestAnimationFrame(look);
"""
SEEN = """() => {
  const painted = performance.getEntriesByName("first-contentful-paint")[0];
  return painted && window.live_seen && [Math.max(painted.startTime, window.table_seen), window.live_seen];
}"""
TICKS = os.sysconf("SC_CLK_TCK")
WATCH_FRAMES = """() => {
  window.frames_seen = [];
  let last = performance.now();
  const step = (now) => { window.frames_seen.push(now - last); last = now; requestAnimationFrame(step); };
  requestAnimationFrame(step);
}"""


def measure(full: bool) -> Tables:
    """The lobby while strokes are played: 8 s and 8 s, or 40 s and 40 s in a full run."""
    os.environ.update(SETTINGS)
    seconds = FULL if full else SHORT
    with tempfile.TemporaryDirectory() as name, running(Path(name)) as (url, process), browser() as chromium:
        _wait_until_ready(url)
        games = Games(url)
        page = chromium.new_page(viewport={"width": 1400, "height": 2600})
        page.goto(url)
        page.locator("a.thumbnail .names").nth(GAMES - 1).wait_for()
        games.play(WARM_UP)
        live = _processors(games, process.pid, seconds) | _frames(page, games, seconds)
        page.close()
        return {"live": [live], "opened": _openings(chromium, url, games, OPENINGS if full else FEW_OPENINGS)}


def _wait_until_ready(url: str) -> None:
    end = time.monotonic() + READY_WITHIN
    while httpx2.get(f"{url}/readyz").status_code != 200:
        if time.monotonic() > end:
            raise TimeoutError(f"the server's physics is not ready after {READY_WITHIN:g} s")
        time.sleep(0.2)


def _processors(games: Games, server: int, seconds: float) -> Row:
    """Cores that browser and server keep busy while the page is watched."""
    before, began = (_browser_time(), _time_of(server)), time.perf_counter()
    strokes, refused = games.play(seconds)
    elapsed = time.perf_counter() - began
    return {
        "games": GAMES,
        "seconds": elapsed,
        "strokes": strokes,
        "refused": refused,
        "browser_cores": (_browser_time() - before[0]) / elapsed,
        "server_cores": (_time_of(server) - before[1]) / elapsed,
    }


def _frames(page: Any, games: Games, seconds: float) -> Row:
    """Times from one frame to the next, ms."""
    page.evaluate(WATCH_FRAMES)
    games.play(seconds)
    frames = sorted(page.evaluate("window.frames_seen"))
    return {
        "frames": len(frames),
        "median_ms": frames[len(frames) // 2],
        "p99_ms": frames[int(0.99 * len(frames))],
        "longest_ms": frames[-1],
    }


def _openings(chromium: Any, url: str, games: Games, count: int) -> list[Row]:
    """Both addresses in turn, each time in a browser context of its own."""
    times: dict[str, list[list[float]]] = {address: [] for address in ADDRESSES}
    for _ in range(count):
        for address, seen in times.items():
            context = chromium.new_context(viewport={"width": 1280, "height": 800})
            page = context.new_page()
            page.add_init_script(WATCH_TABLE)
            page.goto(f"{url}{address}{games.newest()}")
            seen.append(page.wait_for_function(SEEN).json_value())
            context.close()
    return [_opened(f"{address}GAME", seen) for address, seen in times.items()]


def _opened(address: str, seen: list[list[float]]) -> Row:
    """Times to the first picture and to the live one, ms."""
    first, live = (sorted(column) for column in zip(*seen, strict=True))
    return {
        "address": address,
        "openings": len(seen),
        "median_ms": first[len(first) // 2],
        "p95_ms": first[int(0.95 * len(first))],
        "longest_ms": first[-1],
        "live_median_ms": live[len(live) // 2],
    }


def _browser_time() -> float:
    """Processor time of the Chromium that this process has started, s."""
    return sum(_time_of(process) for process, name in _below(os.getpid()) if name.startswith("chrom"))


def _below(root: int) -> Iterator[tuple[int, str]]:
    """Processes that this one has started, and those that they have: id and name."""
    parents: dict[int, tuple[int, str]] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with _vanishing():
            name, _, rest = stat.read_text().partition("(")[2].rpartition(")")
            parents[int(stat.parent.name)] = int(rest.split()[1]), name
    for process, (_, name) in parents.items():
        above = process
        while above in parents and above != root:
            above = parents[above][0]
        if above == root:
            yield process, name


def _time_of(process: int) -> float:
    """Processor time of a process, s; 0 when it has left."""
    with _vanishing():
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / TICKS
    return 0.0


@contextmanager
def _vanishing() -> Iterator[None]:
    """A process may leave while it is read of."""
    try:
        yield
    except (OSError, ValueError, IndexError):
        return


if __name__ == "__main__":
    main("page", measure)
