"""What clients send: unknown fields, wrong types and numbers that are none are errors; examples are good."""

import json
import math

import pytest
from pydantic import BaseModel, ValidationError

import protocol as wire
from physics.errors import InvalidState, InvalidTable
from physics.shot import Shot
from physics.table import Table
from protocol.values import Request
from referee.game import Action, Call, Decision
from server.errors import invalid_fields
from tournament import Spec

SHOT = {"v": 3.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 4.0}
STROKE = {"shot": SHOT, "call": {"ball": 3, "pocket": 0}, "cue_ball": [0.5, 1.7]}
REQUESTS = sorted(
    (
        model
        for model in vars(wire).values()
        if isinstance(model, type) and issubclass(model, Request) and model is not Request
    ),
    key=lambda model: model.__name__,
)


def examples(model):
    extra = model.model_config.get("json_schema_extra") or {}
    return extra.get("examples", [])


def faults(model, body):
    with pytest.raises(ValidationError) as caught:
        model.model_validate(body)
    return {(error["type"], error["loc"]) for error in caught.value.errors()}


@pytest.mark.parametrize("model", REQUESTS, ids=lambda model: model.__name__)
def test_examples_are_accepted_and_an_unknown_field_never_is(model):
    for example in examples(model):
        read = model.model_validate_json(json.dumps(example))
        assert model.model_validate_json(read.model_dump_json()) == read
        assert ("extra_forbidden", ("surplus",)) in faults(model, example | {"surplus": 1})


def test_every_body_of_a_post_has_examples():
    bodies = {
        wire.AgentRequest,
        wire.MatchRequest,
        wire.ShotRequest,
        wire.DecisionRequest,
        wire.SimulateRequest,
        wire.BatchRequest,
        wire.MinElevationRequest,
    }
    assert all(examples(model) for model in bodies)


def test_models_describe_themselves_for_openapi():
    for model in vars(wire).values():
        if isinstance(model, type) and issubclass(model, BaseModel):
            json.dumps(model.model_json_schema(), allow_nan=False)


def test_a_stroke_becomes_the_referees_action_and_comes_back():
    action = wire.ShotRequest.model_validate(STROKE).to_action()
    assert action == Action(Shot(3.0, 270.0, 5.0, 0.0, 4.0), Call(3, 0), (0.5, 1.7))
    assert wire.ShotRequest.of(action).model_dump(mode="json") == STROKE
    assert wire.SubmittedAction.of(action).to_action() == action
    safety = wire.ShotRequest.model_validate({"shot": SHOT, "call": "safety"}).to_action()
    assert safety == Action(Shot(**SHOT), "safety")
    assert wire.ShotRequest.of(safety).call == "safety"


def test_a_decision_becomes_the_referees_action():
    action = wire.DecisionRequest.model_validate({"decision": "accept_table"}).to_action()
    assert action == Action(decision=Decision.ACCEPT_TABLE)
    assert wire.SubmittedAction.of(action).to_action() == action
    with pytest.raises(ValueError, match="a decision is no shot"):
        wire.ShotRequest.of(action)


@pytest.mark.parametrize("name", sorted(SHOT))
@pytest.mark.parametrize(
    ("value", "kind"),
    [
        (math.nan, "finite_number"),
        (math.inf, "finite_number"),
        (True, "float_type"),
        ("3", "float_type"),
        (None, "float_type"),
        ([1.0], "float_type"),
    ],
)
def test_a_parameter_is_a_finite_number(name, value, kind):
    body = STROKE | {"shot": SHOT | {name: value}}
    assert faults(wire.ShotRequest, body) == {(kind, ("shot", name))}


@pytest.mark.parametrize("name", sorted(SHOT))
def test_every_parameter_is_required(name):
    shot = {key: value for key, value in SHOT.items() if key != name}
    assert faults(wire.ShotRequest, STROKE | {"shot": shot}) == {("missing", ("shot", name))}


@pytest.mark.parametrize(("name", "value"), [("v", -0.1), ("v", 10.1), ("theta", -1), ("theta", 70.5)])
def test_ranges_are_those_of_the_table(name, value):
    """A stroke can be written down; where its table is known it is held to it, by the name it has in the request."""
    assert wire.ShotRequest.model_validate(STROKE | {"shot": SHOT | {name: value}}).shot.to_shot()
    scene = {"balls": {"0": [0.5, 0.5]}, "shot": SHOT | {name: value}}
    ((kind, _),) = faults(wire.SimulateRequest, scene)
    assert kind == "value_error"
    with pytest.raises(ValidationError) as refused:
        wire.BatchRequest.model_validate({"balls": {"0": [0.5, 0.5]}, "shots": [SHOT, SHOT | {name: value}]})
    cause = refused.value.errors()[0]["ctx"]["error"]
    assert (cause.field, cause.value) == (f"shots.1.{name}", value)
    assert cause.allowed == (
        "must be a number from 0 to 10 m/s" if name == "v" else "must be a number from 0 to 70 deg"
    )
    if value > 0:
        assert wire.SimulateRequest.model_validate(scene | {"table": "nine_foot"}).shot


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ({"ball": 0, "pocket": 0}, {("greater_than_equal", ("call", "ball"))}),
        ({"ball": 16, "pocket": 0}, {("less_than", ("call", "ball"))}),
        ({"ball": 3, "pocket": 6}, {("less_than", ("call", "pocket"))}),
        ({"ball": 3.0, "pocket": True}, {("int_type", ("call", "ball")), ("int_type", ("call", "pocket"))}),
        ({"ball": 3}, {("missing", ("call", "pocket"))}),
        ({"ball": 3, "pocket": 1, "kiss": 1}, {("extra_forbidden", ("call", "kiss"))}),
    ],
)
def test_faults_in_a_call_speak_of_the_call_alone(call, expected):
    assert faults(wire.ShotRequest, STROKE | {"call": call}) == expected


@pytest.mark.parametrize("place", [[0.5], [0.5, 1.7, 0.0], [0.5, math.nan], "0.5 1.7", {"x": 0.5, "y": 1.7}])
def test_the_cue_ball_goes_to_two_finite_numbers(place):
    assert all(loc[0] == "cue_ball" for _, loc in faults(wire.ShotRequest, STROKE | {"cue_ball": place}))


@pytest.mark.parametrize("key", ["16", "-1", "03", "3.0", " 3", "cue", "٣"])
def test_balls_are_keyed_by_their_plain_numbers(key):
    body = {"balls": {key: [0.5, 1.0]}, "shot": SHOT}
    with pytest.raises(ValidationError) as caught:
        wire.SimulateRequest.model_validate(body)
    (error,) = caught.value.errors()
    assert isinstance(error["ctx"]["error"], InvalidState)
    assert error["loc"] == ("balls",)


def test_a_table_is_named_changed_or_written_out():
    named = wire.SimulateRequest.model_validate({"balls": {"0": [0.5, 1.0]}, "shot": SHOT})
    assert named.table == Table.olympiad().to_dict()
    changed = wire.MatchRequest(agents=("a", "b"), table={"name": "fastfiz", "mu_slide": 0.25})
    assert Table.from_dict(changed.table) == Table.fastfiz().replace(mu_slide=0.25)
    assert wire.MatchRequest(agents=("a", "b"), table=changed.table).table == changed.table


@pytest.mark.parametrize(
    "table", ["snooker", 7, None, {"mu_slide": 0.2}, {"name": "olympiad", "mu_slide": 5}, {"name": "x"}]
)
def test_other_tables_are_refused_by_name(table):
    with pytest.raises(ValidationError) as caught:
        wire.MatchRequest.model_validate({"agents": ["a", "b"], "table": table})
    (error,) = caught.value.errors()
    assert isinstance(error["ctx"]["error"], InvalidTable)


@pytest.mark.parametrize(
    "terms",
    [
        {"agents": ["a"]},
        {"agents": ["a", "b", "c"]},
        {"games": 0},
        {"games": 1.5},
        {"noise": {"level": 5.1}},
        {"noise": {"level": -1}},
        {"noise": {"level": 1, "told": "yes"}},
        {"clock": {"seconds": 0}},
        {"clock": {"seconds": math.inf}},
        {"seed": "00"},
        {"seed": "G" * 64},
        {"rules": "nine_ball"},
        {"agents": ["a", "b/../c"]},
    ],
)
def test_terms_of_a_match_outside_their_range_are_refused(terms):
    with pytest.raises(ValidationError):
        wire.MatchRequest.model_validate({"agents": ["a", "b"]} | terms)


@pytest.mark.parametrize("name", ["", " ", "x" * 65, "<script>", "a\nb", "-rf"])
def test_names_are_plain(name):
    with pytest.raises(ValidationError):
        wire.AgentRequest(name=name)


def test_a_request_may_name_the_pocket_and_answers_have_its_number():
    request = wire.ShotRequest.model_validate(STROKE | {"call": {"ball": 3, "pocket": "NE"}})
    assert request.to_action().call == Call(3, 3)
    assert request.model_dump(mode="json")["call"] == {"ball": 3, "pocket": 3}
    assert faults(wire.ShotRequest, STROKE | {"call": {"ball": 3, "pocket": "north"}}) == {
        ("int_type", ("call", "pocket"))
    }


def test_terms_of_a_tournament_are_its_spec_and_described_as_such():
    """In either form of an event file; sent as `Spec.to_dict` writes them."""
    spec = Spec.from_dict({"name": "Cup", "entrants": ["ann", "bob"], "noise": 2})
    for terms in (spec, spec.to_dict(), {"name": "Cup", "entrants": ["ann", "bob"], "noise": 2}):
        request = wire.TournamentRequest.model_validate({"terms": terms})
        assert request.terms == spec
        assert json.loads(request.model_dump_json())["terms"] == spec.to_dict()
    described = wire.TournamentRequest.model_json_schema()["$defs"]
    assert set(described["Spec"]["properties"]) == {*spec.to_dict(), "lots", "preset", "foreseeable"}
    assert [one.get("type") for one in described["Entrant"]["anyOf"]] == ["string", "object"]


@pytest.mark.parametrize(
    ("terms", "detail"),
    [
        ({"name": "Cup"}, "terms.entrants = None: must be given"),
        (
            {"name": "Cup", "entrants": ["a", "b"], "noise": {"levels": [9]}},
            "terms.noise.levels.0 = 9: must be a number from 0 to 5",
        ),
        ("Cup", "terms: Input should be a valid dictionary"),
    ],
)
def test_terms_that_cannot_be_are_named_once(terms, detail):
    with pytest.raises(ValidationError) as caught:
        wire.TournamentRequest.model_validate({"terms": terms})
    assert str(invalid_fields(caught.value)) == detail
