"""Any language can play: a whole game with nothing but the `curl` program, JSON and school geometry."""

import json
import math
import shutil
import subprocess

from support.require import require

RADIUS = 0.028575
BY_THE_RULES = {"R42", "R43", "R44", "R45", "R46", "R49"}


def curl(hall, token, method, path, body=None, **headers):
    """One request by the curl program: the answer's JSON, None for no content."""
    command = ["curl", "-sS", "--fail-with-body", "--max-time", "60", "-X", method, hall.url + path]
    for name, value in ({"Authorization": f"Bearer {token}"} | headers).items():
        command += ["-H", f"{name.replace('_', '-')}: {value}"]
    if body is not None:
        command += ["-H", "Content-Type: application/json", "-d", json.dumps(body)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{method} {path}: {done.stderr}{done.stdout}"
    return json.loads(done.stdout) if done.stdout else None


def aim(view, cue_ball):
    """Azimuth and call: the callable ball and pocket that need the least cut; the rack on the break."""
    width, length = view["table"]["width"], view["table"]["length"]
    if not view["allowed"]["call_required"]:
        return math.degrees(math.atan2(0.25 * length - cue_ball[1], 0.5 * width - cue_ball[0])), None
    pockets = [(0.05, 0.05), (0.03, length / 2), (0.05, length - 0.05)]
    pockets += [(width - x, y) for x, y in reversed(pockets)]
    best = None
    for ball in view["callable_balls"]:
        x, y = view["balls"][str(ball)]
        for pocket, (mouth_x, mouth_y) in enumerate(pockets):
            run = math.hypot(mouth_x - x, mouth_y - y)
            ghost = x - 2 * RADIUS * (mouth_x - x) / run, y - 2 * RADIUS * (mouth_y - y) / run
            phi = math.atan2(ghost[1] - cue_ball[1], ghost[0] - cue_ball[0])
            cut = abs(math.remainder(phi - math.atan2(mouth_y - y, mouth_x - x), 2 * math.pi))
            if best is None or cut < best[0]:
                best = cut, math.degrees(phi), {"ball": ball, "pocket": pocket}
    return (best[1], best[2]) if best else (270.0, "safety")


def place(view):
    """A free place for the cue ball in hand: the first on a line across its area."""
    area = view["cue_ball_area"]
    y = 0.5 * sum(area["y"])
    for step in range(2, 30):
        x = area["x"][0] + step / 32 * (area["x"][1] - area["x"][0])
        others = [xy for ball, xy in view["balls"].items() if ball != "0"]
        if all(math.dist((x, y), other) > 2.1 * RADIUS for other in others):
            return [x, y]
    raise AssertionError(f"no room in {area}")


def act(hall, token, view):
    """Answer one view."""
    headers = {"If_Match": f'"{view["version"]}"', "Idempotency_Key": f"{view['game']}-{view['version']}"}
    path = f"/v1/games/{view['game']}"
    if view["allowed"]["decisions"]:
        decision = {"decision": view["allowed"]["decisions"][0]}
        return curl(hall, token, "POST", f"{path}/decisions", decision, **headers)
    cue_ball = place(view) if view["cue_ball_area"] else None
    balls = view["balls"] | ({"0": cue_ball} if cue_ball else {})
    phi, call = aim(view, balls["0"])
    scene = {"table": view["table"], "balls": balls, "phi": phi}
    least = curl(hall, token, "POST", "/v1/min-elevation", scene)["theta"]
    theta = min(70.0, 45.0 if least is None else least + 1.0)
    speed = 3.0 if view["allowed"]["call_required"] else 9.0
    shot = {"v": speed, "phi": phi, "theta": theta, "a": 0.0, "b": 0.0}
    return curl(hall, token, "POST", f"{path}/shots", {"shot": shot, "call": call, "cue_ball": cue_ball}, **headers)


def test_a_game_played_with_curl_alone_reaches_its_end(hall):
    require(shutil.which("curl") is not None, "the curl program")
    tokens = [
        curl(hall, hall.organiser_token, "POST", "/v1/agents", {"name": f"curl-{id(hall)}-{seat}"}) for seat in (0, 1)
    ]
    terms = {"agents": [entry["agent"]["id"] for entry in tokens], "seed": "07" * 32, "noise": {"level": 1.0}}
    match = curl(hall, hall.organiser_token, "POST", "/v1/matches", terms, Idempotency_Key="curl-match")
    over = None
    while over is None:
        for entry in tokens:
            message = curl(hall, entry["token"], "GET", "/v1/turns?wait=0")
            if message and message["type"] == "turn":
                act(hall, entry["token"], message["view"])
            elif message and message["type"] == "match_over":
                over = message
    (game,) = curl(hall, hall.organiser_token, "GET", f"/v1/matches/{match['id']}")["played"]
    assert over["status"] == "finished"
    assert game["outcome"]["rule"] in BY_THE_RULES
