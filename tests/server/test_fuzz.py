"""CONTRACT: never 500 for anything a client sends; every refusal is a problem with a known code."""

import json
from dataclasses import fields
from typing import Any
from urllib.parse import quote

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from physics import Table
from protocol import Problem

PATHS = (
    "/v1/agents",
    "/v1/matches",
    "/v1/games/{game}/shots",
    "/v1/games/{game}/decisions",
    "/v1/simulate",
    "/v1/simulate/batch",
    "/v1/min-elevation",
)
WORDS = (
    "name agents games rules table noise level told clock seconds seed shot v phi theta a b call ball pocket",
    "cue_ball decision balls shots tables trace 0 3 8 mu_slide",
)
KEYS = st.sampled_from([word for line in WORDS for word in line.split()])
NUMBERS = st.integers() | st.floats() | st.sampled_from([0, 0.5, 1.7, 3, 270.0, 1e308, -1e308, 1e-320, 2**53 + 1])
LEAVES = st.none() | st.booleans() | NUMBERS | st.text(max_size=8) | KEYS | st.sampled_from(["safety", "olympiad"])
VALUES = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner, max_size=6),
    max_leaves=15,
)
SHOTS = st.fixed_dictionaries(dict.fromkeys(("v", "phi", "theta", "a", "b"), NUMBERS))
PLACES = st.dictionaries(st.sampled_from(["0", "1", "8", "15"]), st.tuples(NUMBERS, NUMBERS), max_size=3)
SCENES = st.fixed_dictionaries({}, optional={"shot": SHOTS, "balls": PLACES, "shots": st.lists(SHOTS, max_size=3)})
PARAMETERS = st.sampled_from([field.name for field in fields(Table)] + ["mouths", "ball_radius", "digest", "replace"])
NAMED = st.builds(
    lambda changes, name: changes | {"name": name},
    st.dictionaries(PARAMETERS, VALUES, max_size=3),
    st.sampled_from(["olympiad", "fastfiz"]) | VALUES,
)
"""Tables of a known name with anything for parameters, and of a name that is anything."""
WHOLE_SCENE = {
    "balls": {"0": [0.5, 1.7], "3": [0.4, 0.6]},
    "shot": {"v": 2.0, "phi": 260.0, "theta": 8.0, "a": 0.0, "b": 3.0},
}
BODIES = (VALUES | SCENES | st.builds(dict, SCENES, phi=NUMBERS)).map(lambda value: json.dumps(value).encode())
BODIES |= st.binary(max_size=40)
QUICK = settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture(scope="module")
def seated(server, table_at):
    """A game with time to spare, and its mover."""
    table = table_at(server, clock={"seconds": 86400.0})
    mover, view = table.mover()
    return mover, view


def check(response):
    assert response.status_code < 500, (response.status_code, response.text)
    if response.status_code >= 400:
        problem = Problem.model_validate_json(response.content)
        assert problem.status == response.status_code


@pytest.mark.parametrize("path", PATHS)
def test_any_body(seated, path):
    mover, view = seated

    @QUICK
    @given(BODIES)
    def send(body):
        headers = {
            "Content-Type": "application/json",
            "If-Match": f'"{view["version"]}"',
            "Idempotency-Key": "fuzz",
        }
        check(mover.request("POST", path.format(game=view["game"]), content=body, headers=headers))

    send()


@pytest.mark.parametrize("path", ["/v1/simulate", "/v1/simulate/batch", "/v1/min-elevation", "/v1/matches"])
def test_any_table(seated, path):
    """All else is well formed or comes after, so that the table's values reach the physics."""
    mover, _ = seated
    others: dict[str, dict[str, Any]] = {
        "/v1/simulate": WHOLE_SCENE,
        "/v1/simulate/batch": {"balls": WHOLE_SCENE["balls"], "shots": [WHOLE_SCENE["shot"]]},
        "/v1/min-elevation": {"balls": WHOLE_SCENE["balls"], "phi": 0.0},
        "/v1/matches": {"agents": [mover.id, "agent_0"]},
    }

    @QUICK
    @given(NAMED | VALUES)
    def send(table):
        body = json.dumps(others[path] | {"table": table}).encode()
        headers = {"Content-Type": "application/json", "Idempotency-Key": "fuzz"}
        check(mover.request("POST", path, content=body, headers=headers))

    send()


@QUICK
@given(
    key=st.text(st.characters(codec="latin-1", exclude_characters="\r\n\0"), max_size=30),
    version=st.text(st.characters(codec="latin-1", exclude_characters="\r\n\0"), max_size=30),
    kind=st.text(st.characters(codec="ascii", exclude_characters="\r\n\0"), max_size=30),
)
def test_any_header(seated, key, version, kind):
    mover, view = seated
    headers = {"Idempotency-Key": key, "If-Match": version, "Content-Type": kind}
    raw = {name.encode(): value.strip().encode("latin-1") for name, value in headers.items()}
    if all(32 <= byte != 127 for value in raw.values() for byte in value):
        check(mover.request("POST", f"/v1/games/{view['game']}/shots", content=b"{}", headers=raw))


@QUICK
@given(
    part=st.text(max_size=20),
    query=st.dictionaries(st.sampled_from(["cursor", "limit", "agent", "status"]), st.text(max_size=20)),
)
def test_any_address(server, part, query):
    for path in (
        "/v1/agents",
        "/v1/matches",
        f"/v1/matches/{quote(part, safe='')}",
        f"/v1/games/{quote(part)}/shots",
    ):
        check(server.request("GET", path, params=query))
