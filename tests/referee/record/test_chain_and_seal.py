"""Chained, signed records: docs/protocol.md, Record. Any byte, any line, any order: verification says where.

Ed25519 against RFC 8032, section 7.1.
"""

import itertools
import json
from dataclasses import replace
from functools import cache

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from support.players import Potter

from client.local_game import play_game
from physics import Table
from referee.game import EndReason, Outcome
from referee.play import MatchSeed, NoiseModel
from referee.record import (
    GENESIS,
    Chain,
    PublicKey,
    RecordVerdict,
    SealState,
    SigningKey,
    canonical,
    end_entry,
    line_digest,
    read_record,
    signed_seal,
    stroke_entry,
    verify_record,
)
from referee.rules import EightBall

KEY = SigningKey(bytes(range(32)))
OTHER = SigningKey(bytes(range(1, 33)))
SIGNED_AT = "2026-11-22T04:00:00Z"


@cache
def short_game():
    """A game of two strokes, ended by a forfeit: short enough to be verified hundreds of times."""
    seed = MatchSeed(bytes(range(32)), client_seeds=(bytes(32), None))
    return play_game(EightBall(Table.olympiad()), (Potter("a"), Potter("b")), seed.game(0), NoiseModel(1.0))


@cache
def signed_lines(key=KEY):
    game, chain = short_game(), Chain()
    lines = [chain.add(game.header.to_dict())]
    lines += [chain.add(stroke_entry(stroke, n)) for n, stroke in enumerate(game.strokes[:2])]
    outcome = Outcome(1 - game.strokes[1].game.turn, EndReason.FORFEIT, "R48")
    lines.append(chain.add(end_entry(2, outcome, game.seeds)))
    lines.append(chain.add(signed_seal(key, chain.head, SIGNED_AT)))
    return tuple(lines)


def signed_text():
    return "".join(f"{line}\n" for line in signed_lines())


def resealed(lines, key):
    """The record signed by somebody else, its other lines untouched."""
    chain = Chain(line_digest(lines[-2]))
    return [*lines[:-1], chain.add(signed_seal(key, chain.head, SIGNED_AT))]


def chained(objects):
    chain = Chain()
    return [chain.add(each) for each in objects]


@pytest.fixture
def write(tmp_path):
    def written(text):
        path = tmp_path / "game.jsonl"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return written


def test_the_chain_starts_from_the_documented_value():
    assert GENESIS == "275ded4be2632a10b77ca41acaccecb425a8ba8845d7a14240afd0b638693e4a"
    lines = signed_lines()
    assert json.loads(lines[0])["previous"] == GENESIS
    for before, after in itertools.pairwise(lines):
        assert json.loads(after)["previous"] == line_digest(before)


def test_a_signed_record_is_verified_with_its_key():
    found = verify_record(signed_lines(), [OTHER.public, KEY.public])
    assert found.ok
    assert (found.seal.state, found.seal.key) == (SealState.VALID, KEY.public.id)
    assert str(found).endswith(f"signed by key {KEY.public.id}")


def test_without_a_key_the_signature_is_said_to_be_unchecked():
    found = verify_record(signed_lines())
    assert found.ok
    assert found.seal.state is SealState.UNCHECKED
    assert "not checked: no key was given" in str(found)


def test_an_unsigned_record_says_so_and_is_refused_when_a_key_is_given():
    lines = list(short_game().record())
    plain = verify_record(lines)
    assert plain.ok
    assert "; unsigned" in str(plain)
    asked = verify_record(lines, [KEY.public])
    assert asked.verdict is RecordVerdict.BAD_SIGNATURE
    assert "the record is unsigned" in str(asked)


def test_a_forged_signature_is_found():
    """Somebody signs a true record with a key of their own, and names the server's."""
    forged = resealed(signed_lines(), OTHER)
    unknown = verify_record(forged, [KEY.public])
    assert unknown.verdict is RecordVerdict.BAD_SIGNATURE
    assert f"key {OTHER.public.id} is not among those given ({KEY.public.id})" in str(unknown)
    seal = json.loads(forged[-1]) | {"key": KEY.public.id}
    named = verify_record([*forged[:-1], canonical(seal)], [KEY.public])
    assert named.verdict is RecordVerdict.BAD_SIGNATURE
    assert f"it is not key {KEY.public.id}'s over these lines" in str(named)
    assert verify_record(signed_lines(), []).verdict is RecordVerdict.BAD_SIGNATURE


def test_the_seal_of_another_record_fits_no_other():
    """Signed by the right key, over other lines."""
    objects = [json.loads(line) for line in signed_lines()[:-1]]
    objects[0]["players"] = ["ann", "bob"]
    chain = Chain()
    others = [chain.add(each) for each in objects]
    others.append(chain.add(signed_seal(KEY, chain.head, SIGNED_AT)))
    assert verify_record(others, [KEY.public]).ok
    moved = verify_record([*signed_lines()[:-1], others[-1]], [KEY.public])
    assert (moved.verdict, moved.chain.line) == (RecordVerdict.BROKEN_CHAIN, len(others))
    fitted = json.loads(others[-1]) | {"previous": line_digest(signed_lines()[-2])}
    assert verify_record([*signed_lines()[:-1], canonical(fitted)], [KEY.public]).verdict is RecordVerdict.BAD_SIGNATURE


@pytest.mark.parametrize(
    ("name", "value"),
    [("number", 10**15), ("number", -1), ("number", 0.5), ("games", 10**15), ("games", 0), ("first_breaker", 2)],
)
def test_a_hostile_header_keeps_nobody_busy(name, value):
    """The chain of secrets is hashed as often as the header says: it may not say what it likes."""
    objects = [json.loads(line) for line in signed_lines()]
    objects[0] |= {"games": 10**15 if name == "number" else 1, name: value}
    found = verify_record(chained(objects))
    assert found.verdict is RecordVerdict.MALFORMED
    assert "line 1" in found.problem


@pytest.mark.parametrize(("bounds", "ok"), [
    ((None, None), True),
    (("2026-11-22T04:00:00Z", None), True),
    ((None, "2026-11-22T04:00:00Z"), True),
    (("2026-11-22T04:00:01Z", None), False),
    (("2025-01-01T00:00:00Z", "2026-11-22T03:59:59Z"), False),
])  # fmt: skip
def test_a_key_signs_within_its_time_alone(bounds, ok):
    found = verify_record(signed_lines(), [PublicKey(KEY.public.value, *bounds)])
    assert found.ok == ok
    assert ok or f"signed at {SIGNED_AT}" in found.seal.problem


def test_a_record_of_another_engine_says_what_it_needs_and_what_its_chain_and_signature_are_worth():
    objects = [json.loads(line) for line in signed_lines()]
    objects[0]["engine"] = {"version": "99.0", "digest": "f" * 64}
    whole = resealed(chained(objects), KEY)
    found = verify_record(whole, [KEY.public])
    assert (found.verdict, found.seal.state) == (RecordVerdict.OTHER_ENGINE, SealState.VALID)
    assert str(found).startswith("made by pooliad 99.0")
    assert verify_record(whole, [OTHER.public]).verdict is RecordVerdict.BAD_SIGNATURE
    dropped = verify_record([whole[0], *whole[2:]], [KEY.public])
    assert (dropped.verdict, dropped.chain.line) == (RecordVerdict.BROKEN_CHAIN, 2)
    assert str(dropped).startswith("made by pooliad 99.0")


def test_names_are_pinned_by_the_chain():
    """What no replay can contradict: the chain and the signature do."""
    forged = [signed_lines()[0].replace("seat 0", "seat O"), *signed_lines()[1:]]
    found = verify_record(forged, [KEY.public])
    assert (found.verdict, found.chain.line) == (RecordVerdict.BROKEN_CHAIN, 2)
    assert "line 1 was changed" in str(found)
    rewritten = verify_record(chained(json.loads(line) for line in forged), [KEY.public])
    assert rewritten.verdict is RecordVerdict.BAD_SIGNATURE
    assert "not verified, although 2 strokes and decisions follow" in str(rewritten)


def test_client_seeds_cannot_be_exchanged():
    """Issue: optional client seeds. Swapped between the seats they are others: the first rack says so."""
    objects = [json.loads(line) for line in signed_lines()]
    objects[0]["client_seeds"].reverse()
    found = verify_record(chained(objects))
    assert found.verdict is RecordVerdict.DIFFERENT
    assert (found.difference.line, found.difference.field) == (1, "start.state.1[0]")


@settings(max_examples=120)
@given(st.data())
def test_any_byte_flipped_is_found_and_its_line_named(data):
    """Property: whichever bit of a signed record flips, it is not verified; the chain points at its line."""
    text = signed_text().encode()
    line = data.draw(st.integers(0, len(signed_lines()) - 1))
    start = sum(len(each.encode()) + 1 for each in signed_lines()[:line])
    place = start + data.draw(st.integers(0, len(signed_lines()[line].encode())))
    flipped = bytearray(text)
    flipped[place] ^= 1 << data.draw(st.integers(0, 7))
    try:
        lines = flipped.decode().split("\n")
    except UnicodeDecodeError:
        return
    if lines[-1] == "":
        lines.pop()
    found = verify_record(lines, [KEY.public])
    assert not found.ok
    if found.verdict is RecordVerdict.MALFORMED and found.chain is None:
        # a line feed that is none any more joins two lines; a byte that has become one cuts a line in two
        assert any(f"line {number}" in found.problem for number in (line + 1, line + 2, len(lines))), found.problem
    elif line + 1 < len(signed_lines()):
        assert found.chain.line in (line + 1, line + 2)
    else:
        assert found.chain is not None or found.seal.state is SealState.INVALID


@settings(max_examples=40)
@given(st.permutations(range(5)))
def test_any_other_order_is_found(order):
    assume(list(order) != sorted(order))
    found = verify_record([signed_lines()[n] for n in order], [KEY.public])
    assert found.verdict is RecordVerdict.MALFORMED or found.chain is not None
    assert not found.ok


@settings(max_examples=30)
@given(st.sets(st.integers(0, 4), max_size=4), st.integers(0, 4))
def test_lines_left_out_or_repeated_are_found(kept, twice):
    lines = [signed_lines()[n] for n in sorted(kept)]
    assert not verify_record(lines, [KEY.public]).ok
    repeated = [*signed_lines()[: twice + 1], *signed_lines()[twice:]]
    assert not verify_record(repeated, [KEY.public]).ok


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda text: text[:-1], "must end with a line feed"),
        (lambda text: text + "\n", "must be JSON"),
        (lambda text: text.replace("\n", "\r\n"), "must be canonical JSON"),
        (lambda text: "\ufeff" + text, "line 1"),
    ],
)
def test_a_file_has_one_form(write, change, problem):
    assert verify_record(write(signed_text()), [KEY.public]).ok
    found = verify_record(write(change(signed_text())), [KEY.public])
    assert found.verdict is RecordVerdict.MALFORMED
    assert problem in found.problem


@pytest.mark.parametrize(
    "change",
    [
        {"algorithm": "none"},
        {"key": 7},
        {"signed_at": None},
        {"signature": "00"},
        {"signature": "G" * 128},
        {"signature": ["00"]},
        {"surplus": 1},
    ],
)
def test_a_seal_that_is_none_is_malformed(change):
    *before, last = signed_lines()
    found = verify_record([*before, canonical(json.loads(last) | change)])
    assert found.verdict is RecordVerdict.MALFORMED


def test_the_key_shows_in_no_log():
    assert KEY.value.hex() not in repr(KEY)
    assert repr(KEY.value) not in f"{KEY} {KEY!r}"


def test_ed25519_is_that_of_rfc_8032():
    """RFC 8032, section 7.1, TEST 3."""
    secret = SigningKey(bytes.fromhex("c5aa8df43f9f837bedb7442f31dcb7b166d38535076f094b85ce3a2e0b4458f7"))
    public = "fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025"
    signature = (
        "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac"
        "18ff9b538d16f290ae67f760984dc6594a7c15e9716ed28dc027beceea1ec40a"
    )
    assert secret.public == PublicKey.from_hex(public)
    assert secret.sign(bytes.fromhex("af82")).hex() == signature
    assert secret.public.verifies(bytes.fromhex(signature), bytes.fromhex("af82"))
    assert not secret.public.verifies(bytes.fromhex(signature), bytes.fromhex("af83"))


@pytest.mark.parametrize("text", ["", "00", "zz" * 32, "AB" * 32, None])
def test_what_is_no_public_key_is_refused(text):
    with pytest.raises(ValueError, match=r"public key = .*: must be 64 lower-case hexadecimal digits"):
        PublicKey.from_hex(text)


def test_a_read_record_has_its_lines():
    record = read_record(signed_lines())
    assert [canonical(each) for each in record.objects] == list(record.lines) == list(signed_lines())
    assert replace(record, lines=()).seal["key"] == KEY.public.id
