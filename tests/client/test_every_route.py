"""The SDK has a method for every operation of the server's OpenAPI document, or there is a reason why not."""

import inspect
import re
from typing import Any

import httpx2
import pytest

import client
import physics
from client import errors
from protocol import DisqualifyRequest, TokenRequest, TournamentRequest, VoidRequest
from referee.play import MatchSeed

TABLE = physics.Table.olympiad()
STATE, SHOT = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.5, 0.5)}), physics.Shot(1.0, 270.0, 5.0)
SCENE = TABLE, STATE
ID = "an-id"
MATCH = client.MatchRequest(agents=("a", "b"), seed=MatchSeed.of(1).secret.hex())

WITHOUT_METHOD = {
    ("get", "/v1/stream"): "an endless answer, for pages that follow all games; the SDK reads strokes by page",
    ("get", "/v1/games/{}/stream"): "the same for one game",
    (
        "get",
        "/v1/games/{}/position.svg",
    ): "for pages and previews, which have its address; `pictures.svg` draws it here",
    ("get", "/v1/games/{}/position.png"): "the same as PNG",
    ("get", "/v1/best-strokes"): "for the page's lobby; a program has the records, and `tournament.luck` for them",
    ("get", "/v1/games/{}/shots/{}.svg"): "the same for a stroke",
    ("get", "/healthz"): "for whoever runs the server, not for whoever plays",
    ("get", "/readyz"): "the same",
    ("get", "/metrics"): "the same",
}

ARGUMENTS: dict[str, list[tuple[Any, ...]]] = {
    "register": [("name",)],
    "agents": [()],
    "me": [()],
    "rotate_token": [(ID,)],
    "revoke_token": [(ID,)],
    "create_staff_token": [(TokenRequest(name="cup", scopes=("read",)),)],
    "staff_tokens": [()],
    "rotate_staff_token": [(ID,)],
    "revoke_staff_token": [(ID,)],
    "invite": [()],
    "create_match": [(MATCH,)],
    "matches": [()],
    "match": [(ID,)],
    "accept": [(ID,)],
    "add_seed": [(ID, "5" * 64)],
    "keys": [()],
    "abort": [(ID,)],
    "create_tournament": [(TournamentRequest.model_construct(),)],
    "tournaments": [()],
    "tournament": [(ID,)],
    "standings": [(ID,)],
    "tournament_entries": [(ID,)],
    "direct_tournament": [
        *((ID, act) for act in ("start", "pause", "abort")),
        (ID, "void", VoidRequest.model_construct()),
        (ID, "disqualify", DisqualifyRequest.model_construct()),
    ],
    "turns": [()],
    "play": [
        (ID, 1, client.Action(shot=SHOT)),
        (ID, 1, client.Action(decision=client.Decision.ACCEPT_TABLE)),
        (ID, 1, client.Action(decision=client.Decision.CONCEDE)),
    ],
    "act": [
        (ID, 1, client.Action(shot=SHOT)),
        (ID, 1, client.Action(decision=client.Decision.ACCEPT_TABLE)),
        (ID, 1, client.Action(decision=client.Decision.CONCEDE)),
    ],
    "forfeit": [(ID, 0)],
    "clock": [(ID,)],
    "game": [(ID,)],
    "shots": [(ID,)],
    "record": [(ID,)],
    "simulate": [(*SCENE, SHOT)],
    "simulate_batch": [(*SCENE, [SHOT])],
    "min_elevation": [(*SCENE, 270.0)],
    "ladder": [()],
    "tables": [()],
    "table": [(ID,)],
    "describe_table": [(TABLE,)],
}
"""How each method is called, once for each operation it stands for."""


def methods(kind):
    return {name for name, _ in inspect.getmembers(kind, inspect.isfunction) if name[0] != "_"} - {"close"}


def test_both_clients_have_the_same_methods_and_each_is_called_here():
    assert methods(client.Pooliad) == methods(client.AsyncPooliad) == set(ARGUMENTS)


def test_every_operation_has_a_method_or_a_reason(hall):
    document = httpx2.get(f"{hall.url}/openapi.json", timeout=60).json()
    documented = {
        (method, re.sub(r"\{\w+\}", "{}", path)) for path, item in document["paths"].items() for method in item
    }
    asked = set()

    def refuse(request):
        asked.add((request.method.lower(), request.url.path.replace(ID, "{}")))
        return httpx2.Response(500)

    with client.Pooliad("http://server", retry=client.Retry(attempts=1), transport=httpx2.MockTransport(refuse)) as api:
        for name, calls in ARGUMENTS.items():
            for arguments in calls:
                with pytest.raises(errors.PooliadError):
                    getattr(api, name)(*arguments)
    assert asked <= documented
    assert asked | set(WITHOUT_METHOD) == documented
    assert not asked & set(WITHOUT_METHOD)


def test_staff_tokens_are_made_listed_rotated_and_revoked(make, hall):
    organiser = make(hall.url, hall.organiser_token)
    made = organiser.create_staff_token(TokenRequest(name="cup", scopes=("organiser",), seconds=60.0))
    assert made.id in {token.id for token in organiser.staff_tokens().tokens}
    renewed = organiser.rotate_staff_token(made.id)
    assert (renewed.id, renewed.token != made.token) == (made.id, True)
    with pytest.raises(errors.Unauthorized):
        make(hall.url, made.token).invite()
    (code,) = make(hall.url, renewed.token).invite(seconds=60.0).invitations
    assert code
    organiser.revoke_staff_token(made.id)
    with pytest.raises(errors.Unauthorized):
        make(hall.url, renewed.token).invite()
