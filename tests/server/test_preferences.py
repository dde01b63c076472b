"""`Prefer: return=minimal` (RFC 7240): a stroke is answered with the view alone, which has it."""

import pytest

from protocol import MinimalAnswer
from server.http.preferences import wants_minimal

MINIMAL = {"Prefer": "return=minimal"}


@pytest.mark.parametrize(
    ("fields", "wanted"),
    [
        ([], False),
        (["return=minimal"], True),
        (["Return = Minimal"], True),
        (['return="minimal"'], True),
        (["respond-async, return=minimal; foo=bar"], True),
        (["respond-async", "return=minimal"], True),
        (["return=representation, return=minimal"], False),
        (["return=minimal", "return=representation"], True),
        (["return"], False),
        (["minimal, ,=;,return=minimalist"], False),
    ],
)
def test_what_a_header_says(fields, wanted):
    """The grammar of RFC 7240, section 2: the first of two counts, what cannot be read is ignored."""
    assert wants_minimal(fields) is wanted


def sent(player, view, action, key, **headers):
    headers |= {"Idempotency-Key": key, "If-Match": f'"{view["version"]}"'}
    return player.request("POST", f"/v1/games/{view['game']}/shots", headers=headers, json=action)


def test_a_minimal_answer_is_the_view_and_a_full_one_the_default(new_table, break_shot):
    tables = new_table(), new_table()  # of one seed: their breaks are the same
    answers = []
    for table, headers in zip(tables, ({}, MINIMAL), strict=True):
        mover, view = table.mover()
        answers.append(sent(mover, view, break_shot, "break", **headers))
    full, minimal = answers
    assert "Preference-Applied" not in full.headers
    assert minimal.headers["Preference-Applied"] == "return=minimal"
    assert minimal.headers["ETag"] == full.headers["ETag"]
    MinimalAnswer.model_validate_json(minimal.content)
    assert set(minimal.json()) == {"game", "view"}
    (stroke,) = minimal.json()["view"]["strokes_since"]
    assert stroke == {name: full.json()["stroke"][name] for name in stroke}
    assert minimal.json()["view"]["balls"] == full.json()["view"]["balls"]
    assert len(minimal.content) < len(full.content) / 2


def test_what_was_answered_is_answered_again_whatever_is_preferred_then(new_table, break_shot):
    for first, again in (({}, MINIMAL), (MINIMAL, {})):
        mover, view = new_table().mover()
        answer = sent(mover, view, break_shot, "break", **first)
        repeated = sent(mover, view, break_shot, "break", **again)
        assert repeated.content == answer.content
        assert repeated.headers.get("Preference-Applied") == answer.headers.get("Preference-Applied")


def test_decisions_and_concessions_too(new_table):
    mover, view = new_table().mover()
    headers = {"Idempotency-Key": "c", "If-Match": f'"{view["version"]}"'} | MINIMAL
    answer = mover.request("POST", f"/v1/games/{view['game']}/concede", headers=headers)
    assert answer.json()["view"]["outcome"] is not None or answer.json()["view"]["phase"] == "over"
    assert set(answer.json()) == {"game", "view"}
