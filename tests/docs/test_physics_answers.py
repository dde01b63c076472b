"""docs/protocol.md, "The physics": every field of every answer by its name, in the documents and in the OpenAPI."""

import re
from typing import get_args

import pytest
from support.documents import PAGES

import protocol
from physics import Status
from physics.facts import Facts
from protocol.outcomes import BallStateView, EventView
from protocol.physics import FactsView

SECTION = re.search(r"\n## The physics\n(.*?)\n## ", PAGES["docs/protocol.md"].read_text(encoding="utf-8"), re.DOTALL)[
    1
]
ROWS = {name for cell in re.findall(r"^\| ([^|]+) \|", SECTION, re.MULTILINE) for name in re.findall(r"`(\w+)`", cell)}
MODELS = (protocol.SimulateAnswer, protocol.BatchRow, BallStateView, EventView)
FIELDS = {name for model in MODELS for name in model.model_fields} | set(FactsView.__annotations__)


def test_every_field_has_its_row_and_no_row_is_of_another_field():
    assert ROWS == FIELDS
    assert "`results`" in SECTION
    assert "`theta`" in SECTION
    assert set(protocol.BatchAnswer.model_fields) | set(protocol.MinElevationAnswer.model_fields) == {
        "results",
        "theta",
    }


@pytest.mark.parametrize(
    "values", [Status, get_args(BallStateView.model_fields["motion"].annotation)], ids=["status", "motion"]
)
def test_every_value_is_named(values):
    names = {getattr(value, "name", value).lower() for value in values}
    assert names <= set(re.findall(r"`(\w+)`", SECTION))


def test_the_facts_in_the_answer_are_those_of_the_physics():
    assert set(FactsView.__annotations__) == set(Facts.__dataclass_fields__)


def test_the_openapi_names_the_facts():
    schema = protocol.SimulateAnswer.model_json_schema(mode="serialization")
    assert set(schema["$defs"]["FactsView"]["properties"]) == set(FactsView.__annotations__)
