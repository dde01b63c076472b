"""What the load plays: legal strokes that take no thought, at the first ball that may be struck, called as safeties."""

import itertools
import json
import math
from dataclasses import dataclass
from typing import Any

from benchmarks.load_client import Connection

SPOTS = [(x, y) for y in (1.8, 1.7, 1.2, 0.7, 1.45, 0.95) for x in (0.558, 0.358, 0.758, 0.458, 0.658, 0.258)]
"""Where a cue ball in hand may go; the first are in the kitchen."""
CLEAR = 0.08
"""Metres between the centres of balls that do not touch, with some to spare."""

PATIENCE = 12
"""Refused strokes after which a game is given up: the cue has room nowhere."""

_keys = itertools.count()


@dataclass(frozen=True, slots=True)
class Player:
    """An agent in its match."""

    token: str
    match: str


async def begin(
    wire: Connection, number: int, organiser: str, games: int = 1000, seconds: float = 86_400
) -> tuple[Player, Player]:
    """A match between two fresh agents; unless told one that does not end while it is measured."""
    names = [f"load {number} {seat}" for seat in (0, 1)]
    made = [await wire.post("/v1/agents", {"name": name}, organiser, name) for name in names]
    terms = {
        "agents": [one["agent"]["id"] for one in made],
        "games": games,
        "seed": f"{number:064x}",
        "clock": {"seconds": seconds},
    }
    match = await wire.post("/v1/matches", terms, organiser, f"load {number}")
    one, two = (Player(each["token"], match["id"]) for each in made)
    return one, two


def next_request(view: dict[str, Any], players: tuple[Player, Player], tries: int) -> tuple[bytes, bytes]:
    """Head and body of the mover's request; `tries` of them were refused (the cue had no room)."""
    verb, action = action_of(view, tries)
    body = json.dumps(action).encode()
    headers = (
        f"Authorization: Bearer {players[view['turn']].token}\r\n"
        f'If-Match: "{view["version"]}"\r\nIdempotency-Key: {next(_keys)}\r\n'
    )
    return Connection.request("POST", f"/v1/games/{view['game']}/{verb}", len(body), headers), body


def action_of(view: dict[str, Any], tries: int) -> tuple[str, dict[str, Any]]:
    """A decision where one is due, else a stroke; it turns away from those that were refused."""
    if tries > PATIENCE:
        return "concede", {}
    if view["phase"] == "decision":
        return "decisions", {
            "decision": view["allowed"]["decisions"][0] if view["allowed"]["decisions"] else "accept_table"
        }
    balls = {int(ball): place for ball, place in view["balls"].items()}
    cue_ball = None
    if view["cue_ball_area"]:
        cue_ball = balls[0] = next(spot for spot in SPOTS if is_free(spot, balls))
    target = min(ball for ball in balls if ball not in (0, 8)) if len(balls) > 2 else max(balls)
    (x, y), (to_x, to_y) = balls[0], balls[target]
    phi = math.degrees(math.atan2(to_y - y, to_x - x)) + 67.0 * tries
    breaks = view["phase"] == "break"
    shot = {"v": 8.0 if breaks else 3.0, "phi": phi, "theta": 50.0, "a": 0.0, "b": 0.0}
    return "shots", {"shot": shot, "call": None if breaks else "safety", "cue_ball": cue_ball}


def is_free(spot: tuple[float, float], balls: dict[int, Any]) -> bool:
    """Whether the cue ball fits there."""
    return all(math.dist(spot, place) > CLEAR for ball, place in balls.items() if ball)
