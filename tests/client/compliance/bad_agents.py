"""Agents that speak HTTP and do one thing wrong, named by the first argument; `none` does nothing wrong.

With `chunks` as the second argument bodies are sent in chunks, as some HTTP libraries do.
"""

import json
import math
import os
import sys
import time
import urllib.error
import urllib.request
import uuid
from collections.abc import Iterator
from typing import Any

URL, TOKEN = os.environ["POOLIAD_URL"], os.environ["POOLIAD_TOKEN"]
FAULT = sys.argv[1]


if FAULT == "unstartable":
    sys.exit("I was not installed as I should be")


def ask(method: str, path: str, body: Any = None, **headers: str) -> tuple[int, bytes]:
    """Status and content of an answer; 0 when none came."""
    content: bytes | Iterator[bytes] | None
    content = None if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
    sent = {"Authorization": f"Bearer {TOKEN}", "Content-Type": "application/json"} | headers
    if content is not None and sys.argv[2:] == ["chunks"]:
        content = iter([content])
    request = urllib.request.Request(URL + path, content, sent, method=method)
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()
    except OSError:
        return 0, b""


def choose(view: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """An action that is legal in the situations of these tests: straight at the first ball that may be called."""
    if view["allowed"]["decisions"]:
        return "decisions", {"decision": view["allowed"]["decisions"][0]}
    cue_ball, target = view["balls"]["0"], view["balls"][str(view["callable_balls"][0])]
    phi = math.degrees(math.atan2(target[1] - cue_ball[1], target[0] - cue_ball[0]))
    shot = {"v": 2.0, "phi": phi, "theta": 30.0, "a": 0.0, "b": 0.0}
    return "shots", {"shot": shot, "call": "safety", "cue_ball": None}


def answering(version: int) -> dict[str, str]:
    """The headers of a well-formed action."""
    return {"If-Match": f'"{version}"', "Idempotency-Key": uuid.uuid4().hex}


def play(view: dict[str, Any]) -> None:
    """Act on a view, in the way that is asked for."""
    verb, action = choose(view)
    path, proper = f"/v1/games/{view['game']}/", answering(view["version"])
    if FAULT == "crashes":
        sys.exit("something is wrong with me")
    if FAULT == "silent":
        return
    if FAULT == "late":
        time.sleep(4.0)
    if FAULT == "concedes":
        ask("POST", path + "concede", **proper)
        return
    if FAULT == "malformed":
        ask("POST", path + verb, b"{'shot': 1}", **answering(view["version"]))
    if FAULT == "refused":
        ask("POST", path + verb, action | {"call": {"ball": 14, "pocket": 0}}, **answering(view["version"]))
    if FAULT == "no-version":
        ask("POST", path + verb, action, **{"Idempotency-Key": uuid.uuid4().hex})
    if FAULT == "stale":
        ask("POST", path + verb, action, **answering(999))
    if FAULT == "no-key":
        ask("POST", path + verb, action, **{"If-Match": f'"{view["version"]}"'})
    status, content = ask("POST", path + verb, action, **proper)
    if FAULT == "key-reused":
        ask("POST", path + verb, action | {"call": None}, **proper)
    if FAULT == "not-your-turn" and status == 200:
        ask("POST", path + verb, action, **answering(json.loads(content)["view"]["version"]))
    if FAULT == "gives-up" and status == 0:
        time.sleep(60.0)
    if status == 503:
        time.sleep(0.1 if FAULT == "impatient" else 1.1)


last = None
while True:
    status, content = ask("GET", f"/v1/turns?wait={0 if FAULT == 'hammers' else 5}")
    if status != 200:
        time.sleep(0.001 if FAULT == "hammers" else 0.1)
        continue
    message = json.loads(content)
    if message["type"] == "turn":
        last = message["view"]
        play(last)
    elif message["type"] == "game_over" and FAULT == "acts-after-end" and last:
        ask("POST", f"/v1/games/{last['game']}/concede", **answering(last["version"]))
