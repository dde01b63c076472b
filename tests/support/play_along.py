"""A match on a server played with both hands, by a player that aims at ghost balls."""

from dataclasses import dataclass, field
from typing import Any

from support.players import Potter

from protocol import DecisionRequest, ShotRequest, View


@dataclass
class Match:
    """A running match: its server, its view, the players' tokens by seat."""

    server: Any
    view: dict[str, Any]
    tokens: list[str]
    players: list[Potter] = field(default_factory=lambda: [Potter("ann"), Potter("bob")])

    @property
    def id(self) -> str:
        return str(self.view["id"])

    @property
    def game(self) -> str:
        """The id of the game that was begun last."""
        return str(self.server.http.get(f"/v1/matches/{self.id}").json()["played"][-1]["id"])


def play_on(match: Match, strokes: int = 1) -> int:
    """Play so many strokes and decisions, fewer when the match ends; how many were played."""
    for played in range(strokes):
        turn = next_turn(match)
        if turn is None:
            return played
        act(match, *turn)
    return strokes


def next_turn(match: Match) -> tuple[int, View] | None:
    """Who is to act, and the view delivered for it; None when the match is over."""
    if match.server.http.get(f"/v1/matches/{match.id}").json()["status"] != "running":
        return None
    seat = match.server.http.get(f"/v1/games/{match.game}").json()["view"]["turn"]
    while True:
        message = match.server.send("GET", "/v1/turns?wait=10", match.tokens[seat])
        assert message.status_code == 200, message.text
        if message.json()["type"] == "turn":
            return seat, View.model_validate(message.json()["view"])


def act(match: Match, seat: int, view: View) -> None:
    """Answer a view by the seat's player."""
    action = match.players[seat](view)
    if action.decision is not None:
        verb, body = "decisions", DecisionRequest(decision=action.decision).model_dump(mode="json")
    else:
        verb, body = "shots", ShotRequest.of(action).model_dump(mode="json")
    headers = {"If-Match": f'"{view.version}"'}
    answer = match.server.send("POST", f"/v1/games/{view.game}/{verb}", match.tokens[seat], json=body, headers=headers)
    assert answer.status_code == 200, answer.text
