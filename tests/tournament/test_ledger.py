"""An event as its entries tell it (docs/running-tournaments.md, "What is on the disk", "Over HTTP")."""

import random

from hypothesis import given, settings
from hypothesis import strategies as st
from support.events import result_of, spec_of

from tournament import Format, Tournament
from tournament.ledger import Act, Ledger

KINDS = ["game"] * 30 + ["aborted"] * 4 + ["void"] * 3 + ["disqualify", "pause", "go_on", "incident"]


def entry_by_lot(event, chance):
    """A result of a game that is due, or a decision, sensible or not."""
    kind, due = chance.choice(KINDS), chance.choice(event.due)
    if kind == "game":
        return Act("game", {"result": result_of(due, chance.choice([0, 1, None])).to_dict()})
    if kind == "aborted":
        return Act("game", {"result": result_of(due, None).to_dict() | {"reason": "aborted"}})
    if kind == "void":
        return Act("void", {"pair": chance.choice(["r0-m0-p0", "r1-m0-p0", "r9-m9-p9"]), "leg": chance.randrange(2)})
    return Act(kind, {"name": chance.choice([*event.spec.names, "nobody"])} if kind == "disqualify" else {})


def entries_by_lot(spec, chance):
    """A course in the order in which somebody noted it."""
    entries: list[Act] = []
    ledger = Ledger(Tournament(spec))
    while len(entries) < 80 and not ledger.over:
        entries.append(entry_by_lot(ledger.event, chance))
        ledger = ledger.after(entries[-1:])
    return entries


@given(st.integers(0, 2**32), st.sampled_from([Format.ROUND_ROBIN, Format.SWISS, Format.KNOCKOUT]))
@settings(max_examples=40)
def test_it_is_the_same_whether_read_in_parts_or_at_once(seed, kind):
    """A server keeps what it has read and carries out what is new; a file is read from its beginning.

    Seen: read at once, results of a knockout's or a Swiss' later rounds were lost, and those of games played again.
    """
    chance = random.Random(seed)
    spec = spec_of(5, format=kind, rounds=3 if kind is Format.SWISS else None)
    entries = entries_by_lot(spec, chance)
    whole = Ledger(Tournament(spec)).after(entries)
    parts = Ledger(Tournament(spec))
    while entries:
        size = chance.randint(1, len(entries))
        parts, entries = parts.after(entries[:size]), entries[size:]
    assert parts.event.counted == whole.event.counted
    assert parts == whole


def test_it_is_begun_by_the_first_go_on_and_stays_so():
    ledger = Ledger(Tournament(spec_of(2)))
    assert not ledger.after([Act("pause", {})]).begun
    assert ledger.after([Act("go_on", {}), Act("pause", {})]).begun
