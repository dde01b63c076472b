"""Who may do what: docs/protocol.md, tokens. Every route of the server has a line here, or this fails."""

import time
from dataclasses import dataclass
from typing import Any

from server.app import create_app
from server.settings import Settings

PUBLIC = frozenset({"nobody", "reader", "stranger", "mover", "opponent", "organiser", "admin"})
VALID = PUBLIC - {"nobody"}
ORGANISERS = frozenset({"organiser", "admin"})
ADMINS = frozenset({"admin"})
AGENTS = frozenset({"stranger", "mover", "opponent"})
PLAYERS = frozenset({"mover", "opponent"})
VOID = ("unknown", "expired", "revoked")

LET_IN = {
    "GET /openapi.json": PUBLIC,
    "HEAD /openapi.json": PUBLIC,
    "GET /docs": PUBLIC,
    "GET /healthz": PUBLIC,
    "HEAD /healthz": PUBLIC,
    "GET /metrics": PUBLIC,
    "GET /readyz": PUBLIC,
    "HEAD /readyz": PUBLIC,
    "GET /": PUBLIC,
    "GET /games/{game_id}": PUBLIC,
    "GET /web/{name}": PUBLIC,
    "GET /v1/keys": PUBLIC,
    "GET /v1/ladder": PUBLIC,
    "GET /v1/best-strokes": PUBLIC,
    "GET /v1/tables": PUBLIC,
    "GET /v1/tables/{name}": PUBLIC,
    "POST /v1/tables": PUBLIC,
    "POST /v1/matches/{match_id}/seed": PLAYERS,
    "POST /v1/agents": PUBLIC,
    "GET /v1/agents": PUBLIC,
    "GET /v1/agents/me": AGENTS,
    "POST /v1/agents/{agent_id}/token": ORGANISERS | {"mover"},
    "DELETE /v1/agents/{agent_id}/token": ORGANISERS | {"mover"},
    "POST /v1/tokens": ADMINS,
    "GET /v1/tokens": ADMINS,
    "POST /v1/tokens/{token_id}/rotate": ADMINS,
    "DELETE /v1/tokens/{token_id}": ADMINS,
    "POST /v1/invitations": ORGANISERS,
    "POST /v1/matches": ORGANISERS | PLAYERS,
    "GET /v1/matches": PUBLIC,
    "GET /v1/matches/{match_id}": PUBLIC,
    "POST /v1/matches/{match_id}/accept": ORGANISERS | PLAYERS,
    "POST /v1/matches/{match_id}/abort": ORGANISERS,
    "POST /v1/tournaments": ORGANISERS,
    "GET /v1/tournaments": PUBLIC,
    "GET /v1/tournaments/{tournament_id}": PUBLIC,
    "GET /v1/tournaments/{tournament_id}/standings": PUBLIC,
    "GET /v1/tournaments/{tournament_id}/entries": ORGANISERS,
    "POST /v1/tournaments/{tournament_id}/start": ORGANISERS,
    "POST /v1/tournaments/{tournament_id}/pause": ORGANISERS,
    "POST /v1/tournaments/{tournament_id}/abort": ORGANISERS,
    "POST /v1/tournaments/{tournament_id}/void": ORGANISERS,
    "POST /v1/tournaments/{tournament_id}/disqualify": ORGANISERS,
    "GET /v1/turns": AGENTS,
    "GET /v1/games/{game_id}": PUBLIC,
    "GET /v1/games/{game_id}/clock": PUBLIC,
    "GET /v1/games/{game_id}/shots": PUBLIC,
    "GET /v1/games/{game_id}/position.png": PUBLIC,
    "GET /v1/games/{game_id}/position.svg": PUBLIC,
    "GET /v1/games/{game_id}/record": PUBLIC,
    "GET /v1/games/{game_id}/shots/{number}.svg": PUBLIC,
    "GET /v1/games/{game_id}/stream": PUBLIC,
    "GET /v1/stream": PUBLIC,
    "POST /v1/games/{game_id}/shots": PLAYERS,
    "POST /v1/games/{game_id}/decisions": PLAYERS,
    "POST /v1/games/{game_id}/concede": PLAYERS,
    "POST /v1/games/{game_id}/forfeit": ORGANISERS,
    "POST /v1/simulate": PUBLIC,
    "POST /v1/simulate/batch": VALID - {"reader"},
    "POST /v1/min-elevation": PUBLIC,
}
"""Route to the roles that are let in; the match is running, the agent of the address is its mover."""

UNPROTECTED = ("/openapi.json", "/docs", "/healthz", "/readyz", "/metrics", "/", "/games/{game_id}", "/web/{name}")
"""Routes that do not look at a token at all."""


def routes():
    app = create_app(Settings(database="sqlite:///never-opened.db"))
    return sorted(f"{method} {route.path}" for route in app.state.endpoints for method in route.methods)


def test_every_route_has_a_line_and_every_line_a_route():
    assert routes() == sorted(LET_IN)


@dataclass
class Situation:
    """A running match, and everybody's token."""

    server: Any
    ids: dict[str, Any]
    tokens: dict[str, str | None]

    def status(self, route, role):
        """What a role is answered at a route, in a form that is let in for its content only where it has some."""
        method, path = route.split()
        headers = {"Idempotency-Key": f"{route} {role}"}
        if (token := self.tokens[role]) is not None:
            headers["Authorization"] = f"Bearer {token}"
        body: dict[str, Any] = {"json": {"agents": list(self.ids["agents"])}} if route == "POST /v1/matches" else {}
        with self.server.http.stream(method, path.format(**self.ids), headers=headers, **body) as response:
            return response.status_code


def staff(organiser, new_player):
    """Tokens of those who do not play, among them one that expired and one that was revoked."""

    def make(*scopes, seconds=None):
        response = organiser.post("/v1/tokens", {"name": "matrix", "scopes": scopes, "seconds": seconds})
        assert response.status_code == 201, response.text
        return response.json()

    made = {"reader": make("read"), "organiser": make("organiser"), "admin": make("admin"), "spare": make("read")}
    made |= {"expired": make("admin", "organiser", seconds=0.2), "revoked": make("admin", "organiser")}
    assert organiser.request("DELETE", f"/v1/tokens/{made['revoked']['id']}").status_code == 204
    time.sleep(0.25)
    return made | {
        "nobody": {"token": None},
        "unknown": {"token": "pool_agt_" + "A" * 43},
        "stranger": {"token": new_player().token},
    }


def event(organiser, players):
    """A tournament of the match's two players."""
    terms = {"name": "Cup", "entrants": ["ann", "bob"]}
    agents = dict(zip(terms["entrants"], (player.id for player in players), strict=True))
    return organiser.post("/v1/tournaments", {"terms": terms, "agents": agents}).json()["id"]


def situation(server, new_table, made):
    """A fresh match, for requests may end it."""
    table = new_table()
    mover, _ = table.mover()
    opponent = next(player for player in table.players if player.id != mover.id)
    ids = {
        "agent_id": mover.id,
        "match_id": table.match["id"],
        "game_id": table.game,
        "token_id": made["spare"]["id"],
        "tournament_id": event(table.organiser, table.players),
        "name": "page.js",
        "number": 0,
        "agents": (mover.id, opponent.id),
    }
    tokens = {role: each["token"] for role, each in made.items()}
    return Situation(server, ids, tokens | {"mover": mover.token, "opponent": opponent.token})


def test_the_authorization_matrix(server, organiser, new_player, new_table):
    """Let in is whoever is answered neither 401 nor 403; a void token is refused even where none is asked for."""
    made = staff(organiser, new_player)
    shared = situation(server, new_table, made)
    wrong = []
    for route, allowed in LET_IN.items():
        for role in sorted(PUBLIC):
            now = shared if route.startswith(("GET", "HEAD")) else situation(server, new_table, made)
            status = now.status(route, role)
            expected = status not in (401, 403) if role in allowed else status == (401 if role == "nobody" else 403)
            wrong += [] if expected else [(route, role, status)]
        for role in VOID:
            status = shared.status(route, role)
            expected = status != 401 if route.split()[1] in UNPROTECTED else status == 401
            wrong += [] if expected else [(route, role, status)]
    assert wrong == []
