"""Verification of records: true ones are believed, and of a tampered one the first difference is named."""

import copy
import json
import math
import subprocess
import sys
from dataclasses import replace
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.players import Potter

from client.local_game import play_game
from physics import Shot, Table
from referee.game import Action, Decision, EndReason, Outcome
from referee.play import MatchSeed, NoiseModel, play_stroke, start_game
from referee.record import (
    Chain,
    Engine,
    Header,
    InvalidRecord,
    MatchTerms,
    RecordVerdict,
    canonical,
    read_record,
    record_lines,
    this_engine,
    verify_record,
)
from referee.rules import EightBall

RULES = EightBall(Table.olympiad())
SECONDS = 10**9


@cache
def game(seed=4, level=1.0):
    return play_game(
        RULES,
        (Potter("a"), Potter("b")),
        MatchSeed.of(seed).game(0),
        NoiseModel(level),
        players=("ann", "bob"),
    )


@cache
def true_lines():
    return tuple(game().record())


def parsed():
    return [json.loads(line) for line in true_lines()]


def tampered(path, value):
    """The record with one value replaced: ``path`` starts with the line's number from 0."""
    objects = parsed()
    node = objects
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value(node[path[-1]]) if callable(value) else value
    return [canonical(line) for line in objects]


def chained(objects):
    """The lines of a forger who knows how chains are made."""
    chain = Chain()
    return [chain.add(line) for line in objects]


def first_line_with(test):
    return next(number for number, line in enumerate(parsed()) if line["type"] == "stroke" and test(line))


@pytest.mark.parametrize(("seed", "level"), [(4, 1.0), (1, 0.0), (6, 5.0), (12, 1.0)])
def test_a_true_record_is_verified(seed, level):
    played = game(seed, level)
    verification = verify_record(played.record())
    assert verification.ok, str(verification)
    assert verification.strokes == len(played.strokes)
    assert verification.outcome == played.outcome
    assert "bit for bit" in str(verification)


def test_a_fresh_process_needs_nothing_but_the_file(tmp_path):
    path = tmp_path / "game.jsonl"
    path.write_text("".join(f"{line}\n" for line in true_lines()), encoding="utf-8")
    script = f"from referee.record import verify_record as v; r = v({str(path)!r}); print(r); assert r.ok"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("verified: ")


def test_every_line_is_canonical():
    assert all(canonical(json.loads(line)) == line for line in true_lines())


def test_the_commitment_is_in_the_first_line_and_the_secrets_in_the_end_alone():
    seeds = game().seeds
    *before, end, seal = true_lines()
    assert game().header.commitment in before[0]
    assert seeds.noise.hex() in end
    for secret in (seeds.noise, seeds.noise_seed, seeds.racks, seeds.rack(0), MatchSeed.of(4).secret):
        assert all(secret.hex() not in line for line in [*before, seal])


def nudge(number):
    """The next double: the least lie there is."""
    return math.nextafter(number, math.inf)


BREAK, END = 1, -2
EVENT = ("events", 20)
TAMPERINGS = [
    # path, value, line, stroke, event, field starts with
    ((0, "commitment"), "0" * 64, 1, None, None, "commitment"),
    ((0, "start", "state", "5", 0), nudge, 1, None, None, "start.state.5[0]"),
    ((0, "start", "groups"), ["solids", "stripes"], 1, None, None, "start.groups"),
    ((0, "noise", "level"), 1.0000001, 1, None, None, "commitment"),
    ((0, "table", "mu_slide"), 0.25, 1, None, None, "commitment"),
    ((0, "rules", "limits", "dry_visits"), 25, 1, None, None, "commitment"),
    ((0, "match"), "another", 1, None, None, "commitment"),
    ((0, "games"), 2, 1, None, None, "commitment"),
    ((0, "racks", "paired"), True, 1, None, None, "commitment"),
    ((0, "first_breaker"), 1, 1, None, None, "commitment"),
    ((0, "client_seeds", 0), "01" * 32, 1, None, None, "start.state."),
    ((0, "surplus"), 1, 1, None, None, "surplus"),
    ((BREAK, "seat"), lambda seat: 1 - seat, 2, 0, None, "seat"),
    ((BREAK, "stroke"), 7, 2, 0, None, "stroke"),
    ((BREAK, "entry"), 7, 2, 0, None, "entry"),
    ((BREAK, "action", "shot", "v"), nudge, 2, 0, None, "shot.v"),
    ((BREAK, "action", "cue_ball", 0), nudge, 2, 0, None, "before.0[0]"),
    ((BREAK, "before", "0", 0), nudge, 2, 0, None, "before.0[0]"),
    ((BREAK, "shot", "a"), nudge, 2, 0, None, "shot.a"),
    ((BREAK, "shot", "phi"), nudge, 2, 0, None, "shot.phi"),
    ((BREAK, *EVENT, "time"), nudge, 2, 0, 20, "events[20].time"),
    ((BREAK, *EVENT, "kind"), "miracle", 2, 0, 20, "events[20].kind"),
    ((BREAK, *EVENT, "states", 0, "position", 1), nudge, 2, 0, 20, "events[20].states[0].position[1]"),
    ((BREAK, *EVENT, "states", 0, "velocity", 0), nudge, 2, 0, 20, "events[20].states[0].velocity[0]"),
    ((BREAK, *EVENT, "states", 0, "spin", 2), nudge, 2, 0, 20, "events[20].states[0].spin[2]"),
    ((BREAK, *EVENT, "states", 0, "motion"), "asleep", 2, 0, 20, "events[20].states[0].motion"),
    ((BREAK, "events"), lambda events: events[:-1], 2, 0, None, "events["),
    ((BREAK, "status"), "event_limit", 2, 0, None, "status"),
    ((BREAK, "duration"), nudge, 2, 0, None, "duration"),
    ((BREAK, "final", "8", 1), nudge, 2, 0, None, "final.8[1]"),
    ((BREAK, "ruling", "rules"), ["R46"], 2, 0, None, "ruling.rules"),
    ((BREAK, "ruling", "fouls"), ["R32"], 2, 0, None, "ruling.fouls"),
    ((BREAK, "ruling", "words"), "Nothing to see.", 2, 0, None, "ruling.words"),
    ((BREAK, "ruling", "evidence"), [], 2, 0, None, "ruling.evidence"),
    ((BREAK, "game", "turn"), lambda seat: 1 - seat, 2, 0, None, "game.turn"),
    ((BREAK, "game", "groups"), ["solids", "stripes"], 2, 0, None, "game.groups"),
    ((BREAK, "game", "state", "8", 0), nudge, 2, 0, None, "game.state.8[0]"),
    ((END, "noise_secret"), "0" * 64, 1, None, None, "commitment"),
    ((END, "rack_secret"), "0" * 64, 1, None, None, "commitment"),
    ((END, "entries"), 3, None, None, None, "entries"),
    ((END, "outcome", "winner"), lambda seat: 1 - seat, None, None, None, "outcome.winner"),
    ((END, "outcome", "reason"), "concession", None, None, None, "outcome.reason"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("path", "value", "line", "stroke", "event", "field"),
    TAMPERINGS,
    ids=[".".join(map(str, row[0])) for row in TAMPERINGS],
)
def test_every_lie_is_found_and_named(path, value, line, stroke, event, field):
    lines = tampered(path, value)
    verification = verify_record(lines)
    assert verification.verdict is RecordVerdict.DIFFERENT, str(verification)
    difference = verification.difference
    assert difference.line == (line or len(lines) + 1 + END)
    assert verification.chain.line == path[0] % len(lines) + 2
    assert difference.stroke == stroke
    assert event is None or difference.event == event
    assert difference.field.startswith(field)
    assert repr(difference.recorded) in str(verification)
    assert repr(difference.derived) in str(verification)


def test_a_lie_about_a_ball_names_the_ball():
    path = (BREAK, *EVENT, "states", 0, "spin", 2)
    ball = parsed()[BREAK]["events"][20]["states"][0]["ball"]
    assert verify_record(tampered(path, nudge)).difference.ball == ball
    assert verify_record(tampered((BREAK, "final", "8", 1), nudge)).difference.ball == 8


def test_secret_and_commitment_changed_together_are_found_in_the_noise():
    """Whoever invents another noise secret with its commitment is caught at the first noisy shot."""
    objects = parsed()
    forged = replace(game().seeds, noise=MatchSeed.of(99).game(0).noise)
    objects[0]["commitment"] = game().header.terms.commitment(forged, 0)
    objects[END]["noise_secret"] = forged.noise.hex()
    verification = verify_record([canonical(line) for line in objects])
    assert (verification.difference.stroke, verification.difference.field) == (0, "shot.v")


def test_a_stroke_left_out_is_found():
    lines = [*true_lines()[:2], *true_lines()[3:]]
    assert verify_record(lines).verdict is RecordVerdict.DIFFERENT


def test_a_stroke_after_the_end_is_found():
    lines = [*true_lines()[:END], true_lines()[END - 1], *true_lines()[END:]]
    difference = verify_record(lines).difference
    assert difference.field == "action"
    assert "the game is over" in difference.derived


def test_an_action_that_is_not_allowed_is_found():
    number = first_line_with(lambda line: line["action"].get("call"))
    lines = tampered((number, "action", "call"), {"ball": 8, "pocket": 0})
    difference = verify_record(lines).difference
    assert difference.field == "action"
    assert difference.derived.startswith("refused: call.ball = 8")


def test_a_game_cut_short_has_no_such_end():
    """The last strokes left out, the result kept."""
    lines = [*true_lines()[: END - 1], *true_lines()[END:]]
    difference = verify_record(lines).difference
    assert difference.field == "outcome"
    assert difference.derived == "no end: the game goes on"


OTHER = Engine("99.0", "f" * 64)


def made_by_another(change=lambda objects: None):
    """The true game as another engine would have recorded it, committed to that engine; then changed and chained."""
    objects = parsed()
    terms = replace(game().header.terms, engine=OTHER)
    objects[0] |= {"engine": OTHER.to_dict(), "commitment": terms.commitment(game().seeds, 0)}
    change(objects)
    return chained(objects)


def test_a_record_of_another_engine_that_follows_is_the_same_game_and_not_called_verified():
    found = verify_record(made_by_another())
    assert (found.verdict, found.ok, found.needs) == (RecordVerdict.SAME_GAME, True, OTHER)
    assert found.outcome == game().outcome
    words = f"made by {OTHER}; this engine, {this_engine()}, gives the same game, bit for bit"
    assert str(found).startswith(words)
    assert "verified" not in str(found)


def test_a_record_of_another_engine_that_does_not_follow_says_where_it_differs():
    """Whether the record or the engine differs nobody can tell without that engine: it is called neither."""

    def change(objects):
        objects[BREAK]["events"][20]["time"] = nudge(objects[BREAK]["events"][20]["time"])

    found = verify_record(made_by_another(change))
    assert (found.verdict, found.ok, found.needs) == (RecordVerdict.OTHER_ENGINE, False, OTHER)
    assert (found.difference.line, found.difference.field) == (2, "events[20].time")
    assert str(found).startswith(
        f"made by {OTHER}; this engine, {this_engine()}, differs at line 2, stroke 0, event 20"
    )


def test_naming_another_engine_does_not_hide_what_was_committed_to():
    """The commitment covers the engine: a record whose engine is exchanged afterwards is not the same game."""

    def change(objects):
        objects[0]["engine"]["digest"] = "e" * 64

    found = verify_record(made_by_another(change))
    assert found.verdict is RecordVerdict.OTHER_ENGINE
    assert found.difference.field == "commitment"


@pytest.mark.parametrize("line", [0, BREAK, END], ids=["header", "stroke", "end"])
def test_a_record_of_another_engine_that_cannot_be_read_here_is_not_called_malformed(line):
    """It may be of a form that a later version has."""

    def change(objects):
        for name in ("action", "players", "outcome"):
            objects[line].pop(name, None)

    found = verify_record(made_by_another(change))
    assert (found.verdict, found.ok, found.needs) == (RecordVerdict.OTHER_ENGINE, False, OTHER)
    assert "cannot read it: line" in str(found)


def test_another_version_with_the_same_engine_is_no_other_engine():
    """Two versions may differ in comments alone; what they record is verified by both."""
    same = replace(this_engine(), version="99.0")
    objects = parsed()
    objects[0]["engine"] = same.to_dict()
    assert verify_record(chained(objects)).difference.field == "commitment"
    objects[0]["commitment"] = replace(game().header.terms, engine=same).commitment(game().seeds, 0)
    assert verify_record(chained(objects)).verdict is RecordVerdict.VERIFIED


@pytest.mark.parametrize(
    ("lines", "problem"),
    [
        ([], "a record starts with a header"),
        (["{}"], "line 1, type"),
        (["not json"], "line 1"),
        (["[1, 2]"], "must be a JSON object"),
        (['{"type": NaN}'], "NaN is no JSON number"),
    ],
)
def test_what_is_no_record_is_malformed(lines, problem):
    verification = verify_record(lines)
    assert verification.verdict is RecordVerdict.MALFORMED
    assert problem in str(verification)


def test_an_unfinished_record_is_malformed():
    for lines in (true_lines()[:-1], true_lines()[:END]):
        verification = verify_record(lines)
        assert verification.verdict is RecordVerdict.MALFORMED
        assert "must be 'end'" in str(verification)
    assert "the record ends before the game does" in str(verify_record(true_lines()[:1]))


def test_a_cut_line_is_named():
    lines = list(true_lines())
    lines[2] = lines[2][:500]
    assert verify_record(lines).problem.startswith("line 3 = ")


def test_a_binary_file_is_malformed(tmp_path):
    path = tmp_path / "noise"
    path.write_bytes(bytes(range(256)))
    assert verify_record(path).verdict is RecordVerdict.MALFORMED
    with pytest.raises(InvalidRecord, match="UTF-8"):
        read_record(path)


def test_names_with_line_separators_stay_on_their_line(tmp_path):
    """JSON leaves U+2028 as it is; only a line feed ends a line of the record."""
    objects = parsed()
    objects[0]["players"] = ["a\u2028nn", "b\x85ob"]
    path = tmp_path / "game.jsonl"
    path.write_text("".join(f"{line}\n" for line in chained(objects)), encoding="utf-8", newline="\n")
    assert verify_record(path).ok


JUNK = st.sampled_from([None, True, -1, 10**30, 1e300, "", "x", [], {}, [[]], {"a": 1}, [1, 2, 3]])


@settings(max_examples=150)
@given(st.data())
def test_junk_anywhere_is_an_answer_and_never_an_exception(data):
    """Any value of a short record replaced by any junk."""
    objects = copy.deepcopy(_short_record())
    node = objects[data.draw(st.integers(0, len(objects) - 1))]
    while True:
        key = data.draw(st.sampled_from(sorted(node) if isinstance(node, dict) else range(len(node))))
        if not isinstance(node[key], dict | list) or not node[key] or data.draw(st.booleans()):
            break
        node = node[key]
    before = node[key]
    node[key] = data.draw(JUNK)
    try:
        lines = chained(objects)
    except ValueError:  # no JSON
        lines = [json.dumps(line) for line in objects]
    verification = verify_record(lines)
    assert verification.verdict in RecordVerdict
    assert str(verification)
    assert not verification.ok or key in _BELIEVED or before == node[key]


_BELIEVED = {"game", "players", "elapsed_ns", "allowance_ns", "budget", "simulated", 0, 1, "previous"}
"""What a record says about who played, where, and how long they thought, no replay can contradict. The chain is
written anew here: whoever lies may do that, too."""


@cache
def _short_record():
    played = game()
    return [json.loads(line) for line in _lines_of([played.strokes[0]], EndReason.CONCESSION)]


def _lines_of(strokes, reason, charges=(None,), elapsed_ns=(0, 0), allowance_ns=None):
    """A record of these strokes, ended from outside to the loss of whoever is in turn."""
    played = game()
    header = Header.of(
        played.header.terms,
        played.header.start,
        played.seeds,
        game="g",
        players=("ann", "bob"),
        allowance_ns=allowance_ns,
    )
    outcome = Outcome(1 - strokes[-1].game.turn, reason, "R48")
    timed = list(zip(strokes, charges, strict=True))
    return list(record_lines(header, timed, outcome, played.seeds, elapsed_ns))


def test_an_end_from_outside_is_verified():
    """R48: the winner and the rule follow, the reason is the organiser's word."""
    first = game().strokes[:1]
    for reason in (EndReason.FORFEIT, EndReason.CRASH, EndReason.NO_SHOW):
        verification = verify_record(_lines_of(first, reason))
        assert verification.ok, str(verification)
        assert verification.outcome.reason is reason


def test_a_made_up_end_is_found():
    lines = _lines_of(game().strokes[:1], EndReason.EIGHT_MADE)
    assert verify_record(lines).difference.field == "outcome"


@pytest.mark.parametrize(("used", "ok"), [(300 * SECONDS, True), (300 * SECONDS - 1, False)])
def test_a_time_out_rests_on_the_charges(used, ok):
    """Exactly zero left is out of time; one nanosecond is not."""
    stroke = game().strokes[0]
    turn = stroke.game.turn
    charge = 100 * SECONDS
    waited = [0, 0]
    waited[turn] = used - (charge if stroke.seat == turn else 0)
    lines = _lines_of([stroke], EndReason.TIME_OUT, (charge,), waited, 300 * SECONDS)
    verification = verify_record(lines)
    assert verification.ok == ok, str(verification)
    assert ok or verification.difference.field == "outcome"


def test_decisions_and_new_racks_are_part_of_the_record():
    """R12: an illegal break, another rack; the rack follows from the revealed rack seed."""
    seeds, noise = MatchSeed.of(21).game(0), NoiseModel(1.0)
    start = start_game(RULES, seeds)
    soft = Action(Shot(0.3, 270.0, 5.0), cue_ball=(0.558, 1.75))
    strokes = [play_stroke(RULES, start, soft, seeds, noise)]
    for action in (Action(decision=Decision.RERACK_AND_BREAK), Action(decision=Decision.CONCEDE)):
        strokes.append(play_stroke(RULES, strokes[-1].game, action, seeds, noise))
    terms = MatchTerms("m", 1, RULES, noise, first_breaker=0)
    header = Header.of(terms, start, seeds, game="g", players=("ann", "bob"))
    timed = [(stroke, None) for stroke in strokes]
    lines = list(record_lines(header, timed, strokes[-1].game.outcome, seeds))
    assert verify_record(lines).ok
    second = json.loads(lines[2])
    assert "events" not in second
    second["game"]["state"]["3"][0] = nudge(second["game"]["state"]["3"][0])
    difference = verify_record([*lines[:2], canonical(second), *lines[3:]]).difference
    assert (difference.line, difference.stroke, difference.ball) == (3, None, 3)
    assert difference.field == "game.state.3[0]"


@pytest.mark.parametrize("engine", [None, "0.1.0", [], {"version": "0.1.0"}, {"version": 1, "digest": "ab"}])
def test_an_engine_that_is_none_is_said_in_words(engine):
    verification = verify_record(tampered((0, "engine"), engine))
    assert verification.verdict is RecordVerdict.MALFORMED
    assert "line 1, engine" in verification.problem
    assert "strings version and digest" in verification.problem
