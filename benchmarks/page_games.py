"""Games for the page's benchmark: thirty matches on a server, played on in turns at a steady rate."""

import json
import math
import random
import time
import uuid
from typing import Any, Final

import httpx2

import physics

GAMES: Final = 30
STROKES_A_SECOND: Final = 6.0
ORGANISER: Final = "organiser-of-the-page-benchmark-0123456789"
TRIES: Final = 200
STEEPEST: Final = 60.0
"""Degrees the cue is raised at most; directions tried for less, before the referee is asked to refuse."""
MET_CHANGE: Final = frozenset({409, 412, 422})
"""Answers to a stroke that came to a game which was over or had moved on, or that the referee does not take."""


class Games:
    """Matches of simple players, who hit something hard."""

    def __init__(self, url: str) -> None:
        self._http = httpx2.Client(base_url=url, timeout=60)
        self._chance = random.Random(1)
        self._matches = [self._begun(number) for number in range(GAMES)]
        self._next = 0

    def _begun(self, number: int) -> tuple[str, list[str]]:
        """A match and its players' tokens."""
        made = [self._http.post("/v1/agents", json={"name": f"{who} {number}"}).json() for who in ("ann", "bob")]
        request = {"agents": [one["agent"]["id"] for one in made], "games": 50, "clock": {"seconds": 3600}}
        answer = self._send("POST", "/v1/matches", ORGANISER, json=request)
        answer.raise_for_status()
        return answer.json()["id"], [one["token"] for one in made]

    def _send(self, method: str, path: str, token: str, version: int = 0, **options: Any) -> httpx2.Response:
        headers = {"Authorization": f"Bearer {token}", "Idempotency-Key": uuid.uuid4().hex, "If-Match": f'"{version}"'}
        return self._http.request(method, path, headers=headers, **options)

    def newest(self) -> str:
        """A game that is played: that of the match whose turn it is."""
        match, _ = self._matches[self._next]
        return str(json.loads(self._http.get(f"/v1/matches/{match}").content)["played"][-1]["id"])

    def play(self, seconds: float) -> tuple[int, int]:
        """One stroke in each match after another, for so long; how many were played, how many not taken."""
        began, strokes, refused = time.perf_counter(), 0, 0
        while (now := time.perf_counter() - began) < seconds:
            if strokes + refused > now * STROKES_A_SECOND:
                time.sleep(0.01)
                continue
            played = self._stroke(*self._matches[self._next])
            strokes, refused = strokes + played, refused + (not played)
            self._next = (self._next + 1) % GAMES
        return strokes, refused

    def _stroke(self, match: str, tokens: list[str]) -> bool:
        """Something lively in a match's newest game; whether it was played."""
        game = json.loads(self._http.get(f"/v1/matches/{match}").content)["played"][-1]["id"]
        view = json.loads(self._http.get(f"/v1/games/{game}").content)["view"]
        if view["turn"] is None:
            return False
        if decisions := view["allowed"]["decisions"]:
            verb, body = "decisions", {"decision": decisions[0]}
        else:
            verb, body = "shots", self._shot(view)
        answer = self._send("POST", f"/v1/games/{game}/{verb}", tokens[view["turn"]], view["version"], json=body)
        if answer.status_code not in MET_CHANGE:
            answer.raise_for_status()
        return answer.status_code == 200

    def _shot(self, view: dict[str, Any]) -> dict[str, Any]:
        """A hard stroke in any direction that the cue can reach, as a safety."""
        table, place = physics.Table.olympiad(), None
        balls = dict(view["balls"])
        if area := view["cue_ball_area"]:
            place = self._place(table, balls, area)
            balls["0"] = list(place)
        state = physics.TableState.from_dict(balls)
        for _ in range(TRIES):
            phi = self._chance.uniform(0.0, 360.0)
            theta = physics.min_elevation(table, state, phi)
            if theta < STEEPEST:
                break
        else:
            theta = STEEPEST
        shot = {"v": self._chance.uniform(3.0, 8.0), "phi": phi, "theta": theta + 1.0, "a": 0.0, "b": 0.0}
        return {"shot": shot, "call": "safety" if view["allowed"]["call_required"] else None, "cue_ball": place}

    def _place(self, table: physics.Table, balls: dict[str, Any], area: dict[str, Any]) -> tuple[float, float]:
        """A free place for the cue ball in hand."""
        others = [place for ball, place in balls.items() if ball != "0"]
        while True:
            place = (self._chance.uniform(*area["x"]), self._chance.uniform(*area["y"]))
            if table.contains(*place) and all(math.dist(place, other) > 0.06 for other in others):
                return place
