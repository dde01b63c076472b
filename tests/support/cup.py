"""A tournament over HTTP whose players do what a test says."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

SEEDS = {name: hashlib.sha256(name.encode()).hexdigest() for name in ("ann", "bob", "cat", "dan")}
"""What each player adds to the draw."""


class Cup:
    """A tournament of players who do what the test says.

    Args:
        organiser: makes and directs it.
        new_player: registers an agent.
        names: of the entrants; terms: others than those of a cup of one pair.
    """

    def __init__(
        self, organiser: Any, new_player: Callable[[], Any], names: Sequence[str] = ("ann", "bob", "cat"), **terms: Any
    ) -> None:
        self.organiser = organiser
        self.players = {name: new_player() for name in names}
        self.terms = {"name": "Cup", "entrants": list(names), "pairs": 1, "seed": 5, **terms}
        agents = {name: player.id for name, player in self.players.items()}
        response = organiser.post("/v1/tournaments", {"terms": self.terms, "agents": agents})
        assert response.status_code == 201, response.text
        self.id = response.json()["id"]

    @classmethod
    def of(cls, organiser: Any, players: Mapping[str, Any], tournament_id: str) -> "Cup":
        """An event that is there already."""
        cup = cls.__new__(cls)
        cup.organiser, cup.players, cup.id = organiser, dict(players), tournament_id
        cup.terms = cup.read()["terms"]
        return cup

    def at(self, server: Any) -> "Cup":
        """The same event, everybody in it at another server."""
        for player in (self.organiser, *self.players.values()):
            player.server = server
        return self

    def act(self, verb: str, body: Any = None, **options: Any) -> Any:
        """An organiser's decision."""
        return self.organiser.post(f"/v1/tournaments/{self.id}/{verb}", body, **options)

    def read(self, path: str = "") -> dict[str, Any]:
        """The event, or what is below it."""
        response = self.organiser.get(f"/v1/tournaments/{self.id}{path}")
        assert response.status_code == 200, response.text
        return dict(response.json())

    def running(self) -> list[dict[str, Any]]:
        """Its games that are being played."""
        return [game for game in self.read()["played"] if game["status"] == "running"]

    def concede(self, game: dict[str, Any]) -> str:
        """Let whoever is to break a running game concede it."""
        self.add_seeds(game)
        breaker = self.players[game["players"][game["breaker"]]]
        while (message := breaker.turn())["type"] != "turn" or message["view"]["match"] != game["match"]:
            assert message["type"] != "turn"
        view = message["view"]
        assert breaker.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
        return str(view["game"])

    def add_seeds(self, game: dict[str, Any]) -> None:
        """Both players add a seed, if the game's match waits for theirs."""
        if self.organiser.get(f"/v1/matches/{game['match']}").json()["status"] == "opening":
            for name in game["players"]:
                answer = self.players[name].post(f"/v1/matches/{game['match']}/seed", {"seed": SEEDS[name]})
                assert answer.status_code == 200, answer.text

    def play_out(self) -> list[str]:
        """Concede until the event is over; the ids of the games."""
        conceded = []
        while running := self.running():
            conceded.append(self.concede(running[0]))
        return conceded
