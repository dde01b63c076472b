"""Values that check themselves (`tournament.validation`): what they refuse, by whatever way it comes."""

import copy
import dataclasses
import json
import pickle

import pytest

from tournament import Entrant, GameResult, InvalidResult, InvalidSpec, NoisePlan, Spec, SprtTerms

SECRET = "5a" * 32
WHOLE = {"name": "Winter open", "entrants": ["a", "b"], "seed": SECRET, "lots": SECRET[::-1]}


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: SprtTerms(5, 5), "sprt.elo1 = 5.0: must be more than elo0 = 5"),
        (lambda: SprtTerms(0, True), "sprt.elo1 = True: must be a number from -1000 to 1000"),
        (lambda: SprtTerms(zz=3), "sprt.zz = 3: must be left out; the fields are elo0, elo1, alpha, beta"),  # type: ignore[call-arg]
        (lambda: SprtTerms(1, 2, 0.1, 0.1, 5), "sprt[4] = 5: must be left out"),  # type: ignore[call-arg]
        (lambda: NoisePlan((9,)), "noise.levels[0] = 9: must be a number from 0 to 5"),
        (lambda: NoisePlan((), (4, 2)), "noise.range = (4.0, 2.0): must be the lowest level, then the highest"),
        (lambda: Entrant(" a"), "entrant.name = ' a': must be 1 to 64 printable letters"),
        (lambda: Spec("e"), "entrants = None: must be given"),  # type: ignore[call-arg]
        (lambda: Spec("e", ("a", 3)), "entrants[1] = 3: must be an object"),  # type: ignore[arg-type]
        (
            lambda: dataclasses.replace(Spec("e", (Entrant("a"), Entrant("b"))), pairs=0),
            "pairs = 0: must be an integer from 1",
        ),
    ],
)
def test_constructors_name_what_cannot_be(make, words):
    with pytest.raises(InvalidSpec) as error:
        make()
    assert str(error.value).startswith(words)


def test_a_result_given_by_position_is_named_by_its_fields():
    with pytest.raises(InvalidResult, match="reason = 'bored': must be one of"):
        GameResult("p", 0, ("a", "b"), 0, 1, "bored")  # type: ignore[arg-type]


def test_values_are_values():
    """Equal, immutable, hashable, the same on the other side of a pickle or of JSON."""
    result = GameResult("p", 0, ["a", "b"], 0, 1, "eight_made", fouls=({"R33": 1}, {}))  # type: ignore[arg-type]
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), dataclasses.replace(result)):
        assert again == result
        assert hash(again) == hash(result)
    assert GameResult.from_dict(json.loads(json.dumps(result.to_dict()))) == result
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.leg = 1  # type: ignore[misc]
    assert Spec("e", ("a", {"name": "b"}), noise=2.5) == Spec(  # type: ignore[arg-type]
        "e", (Entrant("a"), Entrant("b")), noise=NoisePlan((2.5,))
    )


@pytest.mark.parametrize("field", [one.name for one in dataclasses.fields(Spec)] + ["preset", "foreseeable", "unknown"])
@pytest.mark.parametrize("value", [-1, 10**400, float("nan"), "x" * 10_000, [], [[]], {}, {1: 2}, b"x", "\ud800"])
def test_no_error_repeats_a_secret(field, value):
    """Terms come whole, with their secrets; what is wrong is one field of them."""
    with pytest.raises(InvalidSpec) as error:
        Spec.from_dict(WHOLE | {"rounds": 3, field: value})
    assert "5a5a" not in str(error.value)
    assert "a5a5" not in str(error.value)
    assert len(str(error.value)) < 1000
