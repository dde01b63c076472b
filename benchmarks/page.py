"""The page with 30 live games: the processor time of the browser, and its longest frame.

A real server, strokes of simple players over HTTP, Chromium without a window and without a graphics card. The
browser's time is that of all its processes; a frame's, from one to the next as the page is told of them.
"""

import json
import math
import os
import random
import tempfile
import time
import uuid
from pathlib import Path
from typing import Any

import httpx2

import physics
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from benchmarks.screenshots import browser, server

GAMES = 30
STROKES_A_SECOND = 6.0
ORGANISER = "organiser-of-the-page-benchmark-0123456789"
TICKS = os.sysconf("SC_CLK_TCK")
WATCH_FRAMES = """() => {
  window.frames_seen = [];
  let last = performance.now();
  const step = (now) => { window.frames_seen.push(now - last); last = now; requestAnimationFrame(step); };
  requestAnimationFrame(step);
}"""


def measure(full: bool) -> Tables:
    """The lobby, watched for 20 s, or 60 s in a full run."""
    os.environ["POOLIAD_ORGANISER_TOKEN"] = ORGANISER
    with tempfile.TemporaryDirectory() as name, server(Path(name)) as url, browser() as chromium:
        games = Games(url)
        page = chromium.new_page(viewport={"width": 1400, "height": 2600})
        page.goto(url)
        page.locator("a.thumbnail .names").nth(GAMES - 1).wait_for()
        games.play(GAMES / STROKES_A_SECOND)
        return {"live": [watched(page, games, 60.0 if full else 20.0)]}


def watched(page: Any, games: "Games", seconds: float) -> Row:
    """One row: frames and processor time while strokes are played."""
    page.evaluate(WATCH_FRAMES)
    before, began = processor_seconds(), time.perf_counter()
    strokes = games.play(seconds)
    elapsed = time.perf_counter() - began
    frames = sorted(page.evaluate("window.frames_seen"))
    return {
        "games": GAMES,
        "seconds": elapsed,
        "strokes": strokes,
        "browser_cores": (processor_seconds() - before) / elapsed,
        "frames": len(frames),
        "median_ms": frames[len(frames) // 2],
        "p99_ms": frames[int(0.99 * len(frames))],
        "longest_ms": frames[-1],
    }


class Games:
    """Matches that are played on by turns, at a steady rate."""

    def __init__(self, url: str) -> None:
        self._http = httpx2.Client(base_url=url, timeout=120)
        self._chance = random.Random(1)
        self._games = [self._begun(number) for number in range(GAMES)]
        self._next = 0

    def _begun(self, number: int) -> tuple[str, list[str]]:
        """A game and its players' tokens."""
        made = [self._http.post("/v1/agents", json={"name": f"{who} {number}"}).json() for who in ("ann", "bob")]
        request = {"agents": [one["agent"]["id"] for one in made], "games": 50, "clock": {"seconds": 3600}}
        match = self._send("POST", "/v1/matches", ORGANISER, json=request)
        return match["id"], [one["token"] for one in made]

    def _send(self, method: str, path: str, token: str, version: int = 0, **options: Any) -> Any:
        headers = {"Authorization": f"Bearer {token}", "Idempotency-Key": uuid.uuid4().hex, "If-Match": f'"{version}"'}
        answer = self._http.request(method, path, headers=headers, **options)
        answer.raise_for_status()
        return json.loads(answer.content)

    def play(self, seconds: float) -> int:
        """Strokes of one game after another, for so long; how many."""
        began, strokes = time.perf_counter(), 0
        while (now := time.perf_counter() - began) < seconds:
            if strokes > now * STROKES_A_SECOND:
                time.sleep(0.01)
                continue
            self._stroke(*self._games[self._next])
            self._next = (self._next + 1) % GAMES
            strokes += 1
        return strokes

    def _stroke(self, match: str, tokens: list[str]) -> None:
        """Something lively: a ball that may be called, hard."""
        game = json.loads(self._http.get(f"/v1/matches/{match}").content)["played"][-1]["id"]
        view = json.loads(self._http.get(f"/v1/games/{game}").content)["view"]
        token, path = tokens[view["turn"]], f"/v1/games/{game}"
        if view["allowed"]["decisions"]:
            decision = {"decision": view["allowed"]["decisions"][0]}
            self._send("POST", f"{path}/decisions", token, view["version"], json=decision)
        else:
            self._send("POST", f"{path}/shots", token, view["version"], json=self._shot(view))

    def _shot(self, view: dict[str, Any]) -> dict[str, Any]:
        table, place = physics.Table.olympiad(), None
        state = physics.TableState.from_dict(view["balls"])
        while area := view["cue_ball_area"]:
            place = (self._chance.uniform(*area["x"]), self._chance.uniform(*area["y"]))
            others = [state.position(ball) for ball in state.balls if ball]
            if table.contains(*place) and all(math.dist(place, other) > 0.06 for other in others):
                state = (
                    state.moved(0, place)
                    if 0 in state.balls
                    else physics.TableState.from_dict({**view["balls"], "0": list(place)})
                )
                break
        while True:
            phi = self._chance.uniform(0.0, 360.0)
            theta = physics.min_elevation(table, state, phi)
            if theta < 60.0:
                shot = {"v": self._chance.uniform(3.0, 8.0), "phi": phi, "theta": theta + 1.0, "a": 0.0, "b": 0.0}
                call = "safety" if view["allowed"]["call_required"] else None
                return {"shot": shot, "call": call, "cue_ball": place}


def processor_seconds() -> float:
    """Processor time of all processes called chromium or chrome, s."""
    total = 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = stat.read_text().partition("(")[2].rpartition(")")
        except OSError:
            continue
        if name.startswith("chrom"):
            total += sum(int(field) for field in rest.split()[11:13])
    return total / TICKS


if __name__ == "__main__":
    main("page", measure)
