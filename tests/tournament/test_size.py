"""How long an event is, told from its terms, is how long it gets (`tournament.size`)."""

import pytest
from support.events import result_of, spec_of

from tournament import SprtTerms, Tournament
from tournament.size import games_of, phases_of


def played(spec, winner_of):
    """Pairs that are due at the same time, phase after phase, when all of them are played before anything else."""
    event, phases = Tournament(spec), []
    while not event.finished:
        phases.append(len({due.pair for due in event.due}))
        event = event.with_results(*(result_of(due, winner_of(due)) for due in event.due))
    return tuple(phases)


def better(due):
    return due.pair.players.index(min(due.pair.players))


TERMS = [
    *({"entrants": n, "format": "knockout", "pairs": 2, "extra_pairs": 2} for n in range(2, 10)),
    {"entrants": 7, "format": "swiss", "rounds": 4, "pairs": 3},
    {"entrants": 6, "format": "gauntlet", "challengers": 2},
    {"entrants": 5, "pairs": 2},
]


@pytest.mark.parametrize("terms", TERMS)
def test_the_phases_are_those_that_are_played(terms):
    spec = spec_of(**terms)
    least, most = phases_of(spec)
    assert least == played(spec, better)
    assert most == played(spec, lambda due: None)
    assert games_of(spec) == (2 * sum(least), 2 * sum(most))


def test_a_sequential_test_may_stop_an_event_after_its_first_pair():
    assert phases_of(spec_of(2, pairs=50, sprt=SprtTerms())) == ((1,), (50,))
