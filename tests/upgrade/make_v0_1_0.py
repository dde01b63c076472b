"""Makes `v0_1_0.db.xz` and `v0_1_0.json` with the server of version 0.1.0 (README.md beside this says how).

Everything goes through that server's HTTP interface; only the last step, compaction, looks into the file.
"""

import hashlib
import json
import lzma
import os
import sqlite3
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path
from typing import Any

import httpx2

import client
from protocol import View
from referee.record import this_engine, verify_record

ORGANISER = "the organiser of a fixture, no secret of anybody"
POSITION = {
    "balls": {"0": [0.3, 0.6], "8": [0.9, 1.4], "2": [0.7, 1.2], "10": [0.5, 0.9]},
    "groups": ["solids", "stripes"],
}
PATIENCE = 600.0


class Server:
    """The server of version 0.1.0 over one SQLite file."""

    def __init__(self, database: Path) -> None:
        self.url = f"sqlite:///{database}"
        command = [sys.executable, "-m", "server", "--port", "0", "--database", self.url]
        environment = os.environ | {"POOLIAD_ORGANISER_TOKEN": ORGANISER}
        self.process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout is not None
        self.http = httpx2.Client(base_url=json.loads(self.process.stdout.readline())["url"], timeout=PATIENCE)
        while self.http.get("/readyz").status_code != 200:
            time.sleep(0.5)

    def ask(self, method: str, path: str, token: str = ORGANISER, body: Any = None, **headers: str) -> httpx2.Response:
        """A request that must succeed."""
        sent = {"Authorization": f"Bearer {token}", "Idempotency-Key": str(uuid.uuid4())} | headers
        answer = self.http.request(method, path, headers=sent, json=body)
        assert answer.is_success, f"{method} {path}: {answer.status_code} {answer.text}"
        return answer

    def get(self, path: str, token: str = ORGANISER) -> Any:
        """What is there."""
        return self.ask("GET", path, token).json()

    def stop(self) -> None:
        """In good order, as an operator does before an upgrade."""
        self.http.close()
        self.process.terminate()
        assert self.process.wait(60) == 0


class Cast:
    """Everybody at the server, and what they do."""

    def __init__(self, server: Server) -> None:
        self.server = server
        self.ids: dict[str, str] = {}
        self.tokens: dict[str, str] = {"organiser": ORGANISER}
        for name in ("ann", "bob", "cat", "dan"):
            made = server.http.post("/v1/agents", json={"name": name}).json()
            self.ids[name], self.tokens[name] = made["agent"]["id"], made["token"]

    def match(self, *names: str, by: str = "organiser", **terms: Any) -> dict[str, Any]:
        """A match, or a challenge by one of the two."""
        body = {"agents": [self.ids[name] for name in names], **terms}
        return dict(self.server.ask("POST", "/v1/matches", self.tokens[by], body).json())

    def running(self, match: str) -> dict[str, Any]:
        """The match's game that is on, as its mover sees it in a delivered turn."""
        game = self.server.get(f"/v1/matches/{match}")["played"][-1]
        return dict(self.server.get(f"/v1/games/{game['id']}")["view"])

    def mover(self, match: str) -> tuple[str, dict[str, Any]]:
        """Who is to play a match, and the view delivered for it."""
        seats = self.server.get(f"/v1/matches/{match}")["agents"]
        turn = self.running(match)["turn"]
        name = next(name for name, own in self.ids.items() if own == seats[turn])
        while (message := self.server.get("/v1/turns?wait=10", self.tokens[name]))["type"] != "turn" or (
            message["view"]["match"] != match
        ):
            assert message["type"] != "turn", "a mover has one game at a time here"
        return name, message["view"]

    def act(self, name: str, view: dict[str, Any], action: dict[str, Any], key: str | None = None) -> httpx2.Response:
        """Answer a view."""
        verb = "decisions" if "decision" in action else "shots"
        headers = {"If-Match": f'"{view["version"]}"'} | ({} if key is None else {"Idempotency-Key": key})
        return self.server.ask("POST", f"/v1/games/{view['game']}/{verb}", self.tokens[name], action, **headers)

    def play(self, match: str, *actions: dict[str, Any]) -> None:
        """Whoever is to play does the next of these."""
        for action in actions:
            self.act(*self.mover(match), action)

    def play_out(self, match: str, strokes: int) -> None:
        """The greedy agent of 0.1.0 plays both sides until the game is over; it has to be within so many strokes."""
        player = client.load("greedy")()
        for stroke in range(strokes):
            if self.server.get(f"/v1/matches/{match}")["status"] != "running":
                return
            name, message = self.mover(match)
            view = View.model_validate(message)
            if stroke == 0:
                player.game_started(view)
            self.act(name, message, player.choose(view).to_dict())
        raise SystemExit(f"match {match} is not over after {strokes} strokes")


BREAK = {"shot": {"v": 9.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}, "call": None, "cue_ball": [0.558, 1.8]}
SOFT = {"shot": {"v": 0.3, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 0.0}, "call": None, "cue_ball": [0.558, 1.75]}
CONCEDE = {"decision": "concede"}


def finished(cast: Cast) -> dict[str, str]:
    """Matches that are over, each for another reason; what each shows, with its id."""
    matches: dict[str, str] = {}

    def over(what: str, match: dict[str, Any]) -> str:
        matches[what] = str(match["id"])
        return matches[what]

    whole = over("a whole game by the rules", cast.match("ann", "bob", seed="2" * 64, first_breaker=0))
    cast.play_out(whole, 60)

    another = over("a decision and another rack", cast.match("ann", "bob", noise={"level": 0.5, "told": False}))
    cast.play(another, SOFT, {"decision": "rerack_and_break"}, SOFT, CONCEDE)

    seeds = over(
        "seeds of both players", cast.match("cat", "dan", games=2, racks={"paired": True}, client_seed_seconds=60)
    )
    for name, digit in (("cat", "a"), ("dan", "b")):
        cast.server.ask("POST", f"/v1/matches/{seeds}/seed", cast.tokens[name], {"seed": digit * 64})
    cast.play(seeds, CONCEDE, CONCEDE)

    budget = {"seconds": 60, "simulations": 10}
    position = over("a position and a budget", cast.match("cat", "dan", start=POSITION, clock=budget))
    cast.play(position, CONCEDE)

    late = over("a time-out", cast.match("cat", "dan", clock={"seconds": 0.2}))
    cast.mover(late)
    while cast.server.get(f"/v1/matches/{late}")["status"] == "running":
        time.sleep(0.1)

    off = over("called off", cast.match("cat", "dan"))
    cast.play(off, SOFT)
    cast.server.ask("POST", f"/v1/matches/{off}/abort")
    return matches


def event(cast: Cast, name: str, players: tuple[str, str], *, games: int) -> str:
    """An event of two games, so many of which are conceded at the break."""
    terms = {"name": name, "entrants": list(players), "pairs": 1, "seed": 5}
    agents = {player: cast.ids[player] for player in players}
    made = cast.server.ask("POST", "/v1/tournaments", body={"terms": terms, "agents": agents}).json()["id"]
    cast.server.ask("POST", f"/v1/tournaments/{made}/start")
    for _ in range(games):
        played = cast.server.get(f"/v1/tournaments/{made}")["played"]
        cast.play(next(game["match"] for game in played if game["status"] == "running"), CONCEDE)
    return str(made)


def unfinished(cast: Cast) -> tuple[dict[str, str], dict[str, Any]]:
    """Matches that are on, and a stroke that was answered: its request and the digest of the answer."""
    turn = cast.match("ann", "bob", games=3, clock={"seconds": 3600}, first_breaker=0)
    cast.play(turn["id"], CONCEDE)
    name, view = cast.mover(turn["id"])
    key = str(uuid.uuid4())
    answer = cast.act(name, view, BREAK, key)
    stroke = {"player": name, "game": view["game"], "version": view["version"], "key": key, "action": BREAK}
    stroke["answer"] = hashlib.sha256(answer.content).hexdigest()
    cast.mover(turn["id"])  # the second game is in the middle of a turn
    matches = {"in the middle of a turn": turn["id"]}
    matches["nobody has fetched the turn"] = cast.match("cat", "dan", clock={"seconds": 3600})["id"]
    matches["waits for seeds"] = cast.match("ann", "cat", client_seed_seconds=60)["id"]
    matches["a challenge"] = cast.match("ann", "dan", by="ann")["id"]
    return matches, stroke


def tell(cast: Cast, found: dict[str, Any]) -> dict[str, Any]:
    """What is in the database, with what 0.1.0 served of it."""
    records = {}
    for match in (*found["finished"].values(), found["unfinished"]["in the middle of a turn"]):
        for game in cast.server.get(f"/v1/matches/{match}")["played"]:
            if game["status"] != "running":
                text = cast.server.ask("GET", f"/v1/games/{game['id']}/record").text
                verified = verify_record(text.splitlines())
                assert verified.ok, f"{match}: {verified}"
                records[game["id"]] = hashlib.sha256(text.encode()).hexdigest()
    agents = {name: {"id": own, "token": cast.tokens[name]} for name, own in cast.ids.items()}
    standings = cast.server.get(f"/v1/tournaments/{found['events']['finished']}/standings")["standings"]
    return (
        {"engine": this_engine().to_dict(), "organiser": ORGANISER, "agents": agents}
        | found
        | {
            "keys": cast.server.get("/v1/keys")["keys"],
            "standings": standings,
            "records": records,
        }
    )


def compact(database: Path, target: Path) -> None:
    """The file without free pages, compressed."""
    whole = database.with_name("whole.db")
    with sqlite3.connect(database) as connection:
        connection.execute("VACUUM INTO ?", (str(whole),))
    connection.close()
    target.write_bytes(lzma.compress(whole.read_bytes(), preset=9 | lzma.PRESET_EXTREME))


def perform(server: Server) -> dict[str, Any]:
    """Everything that happens at the server."""
    cast = Cast(server)
    found: dict[str, Any] = {"finished": finished(cast)}
    subprocess.run([sys.executable, "-m", "client.cli", "keys", "rotate", "--database", server.url], check=True)
    found["events"] = {"finished": event(cast, "spring cup", ("cat", "dan"), games=2)}
    found["events"]["running"] = event(cast, "autumn cup", ("cat", "dan"), games=1)
    found["unfinished"], found["stroke"] = unfinished(cast)
    return tell(cast, found)


def main(folder: Path) -> None:
    """Play everything, and leave the two files in the folder."""
    assert this_engine().version == "0.1.0", f"this is {this_engine()}; it must be version 0.1.0"
    with tempfile.TemporaryDirectory() as temporary:
        database = Path(temporary) / "pooliad.db"
        server = Server(database)
        try:
            told = perform(server)
        finally:
            server.stop()
        compact(database, folder / "v0_1_0.db.xz")
    (folder / "v0_1_0.json").write_text(json.dumps(told, indent=1) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
