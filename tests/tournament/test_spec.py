"""The terms of an event (docs/tournaments.md, "Terms"): what they may be, and what they say when they cannot."""

import json
import math

import pytest
from support.events import spec_of

from physics import Table
from physics.table import NAMED
from tournament import PRESETS, RECOMMENDED, Entrant, InvalidSpec, NoisePlan, Spec, SprtTerms, Tournament, game_seeds

WHOLE = {"name": "Winter open", "entrants": ["greedy", {"name": "b", "agent": "python b.py"}]}


@pytest.mark.parametrize(
    "terms",
    [
        {},
        {"format": "swiss", "rounds": 3, "noise": {"range": [0.0, 5.0], "told": False}},
        {"format": "knockout", "drawn": "lot", "seeding": "drawn", "extra_pairs": 0, "seconds": None},
        {"sprt": {"elo0": -5.0, "elo1": 5.0}, "seed": "ab" * 32, "simulated_shots": 1000},
        {"noise": 2.5, "tie_breaks": ["wins", "seed"], "table": "fastfiz"},
        {"lots": "ab" * 32},
        {"lots": "ab" * 32, "seed": "cd" * 32},
    ],
)
def test_terms_survive_json(terms):
    spec = Spec.from_dict(WHOLE | terms)
    assert Spec.from_dict(json.loads(json.dumps(spec.to_dict()))) == spec


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pairs": 0}, "pairs = 0: must be an integer from 1 to 100000"),
        ({"pairs": True}, "pairs = True: must be an integer"),
        ({"pairs": 10**9}, "pairs = 1000000000"),
        ({"format": "ladder"}, "format = 'ladder': must be one of round_robin, gauntlet, swiss, knockout"),
        ({"format": "swiss"}, "rounds = None: must be given"),
        ({"rounds": 3}, "rounds = 3: must be left out"),
        ({"format": "gauntlet", "challengers": 2}, "challengers = 2: must be fewer than the 2 entrants"),
        ({"seconds": 0}, "seconds = 0: must be a number from 0.001 to 86400"),
        ({"seconds": 1e-10}, "seconds = 1e-10: must be a number from 0.001 to 86400"),
        ({"seconds": math.nan}, "seconds = nan: must be a number"),
        ({"noise": 6}, "noise.levels[0] = 6: must be a number from 0 to 5"),
        ({"noise": {"range": [3, 1]}}, "noise.range = (3.0, 1.0): must be the lowest level"),
        ({"noise": {"levels": [1], "range": [0, 5]}}, "either levels or a range"),
        ({"noise": {"levels": []}}, "either levels or a range"),
        ({"noise": {"level": 1}}, "noise.level = 1: must be left out; the fields are levels, range, told"),
        ({"seed": "secret"}, "seed = '<6 letters>': must be 64 lower-case"),
        ({"seed": -1}, "seed = -1"),
        ({"lots": "secret"}, "lots = '<6 letters>': must be 64 lower-case"),
        ({"lots": 5}, "lots = 'int': must be 64 lower-case"),
        ({"seed": 5, "lots": "ab" * 32}, "lots = '<64 letters>': must be left out"),
        ({"seed": 5, "foreseeable": False}, "foreseeable = False: must be true"),
        ({"foreseeable": 1}, "foreseeable = 1"),
        (
            {"table": "snooker"},
            "table = 'snooker': must be olympiad, fastfiz, nine_foot, eight_foot, seven_foot or a table's parameters",
        ),
        ({"table": ["nine_foot"]}, "table = ['nine_foot']: must be olympiad"),
        ({"table": {"name": "nine_foot", "cushion": "soft"}}, "table.cushion = 'soft': must be one of ('han'"),
        ({"table": {"name": "nine_foot", "corner_mouth": 0.2}}, "table.corner_mouth = 0.2: must be a number from 0.09"),
        ({"table": {"name": "olympiad", "width": -1}}, "table.width = -1"),
        ({"table": {"width": -1}}, "table.name = None: must be one of"),
        ({"entrants": ["a", "a"]}, "entrants = 'a': must be names that are all different"),
        ({"entrants": ["a"]}, "entrants = ['a']: must be a list of 2 to 1000"),
        ({"entrants": ["a", "b\n"]}, "entrants[1].name = 'b\\n': must be 1 to 64 printable letters"),
        ({"entrants": ["a", "x" * 65]}, "entrants[1].name = 'xxx"),
        (
            {"entrants": ["a", {"name": "b", "age": 3}]},
            "entrants[1].age = 3: must be left out; the fields are name, agent",
        ),
        ({"preset": "olympiad"}, "preset = 'olympiad': must be one of olympiad-noise-1"),
        ({"wind": 3}, "wind = 3: must be left out; the fields are name, entrants"),
        ({"sprt": {"elo0": 0, "elo1": 0}}, "sprt.elo1 = 0.0: must be more than elo0 = 0"),
        ({"tie_breaks": ["luck"]}, "tie_breaks[0] = 'luck': must be one of direct"),
        ({"entrants": 3}, "entrants = 3: must be a list of 2 to 1000"),
        ({"entrants": ["a", 3]}, "entrants[1] = 3: must be an object"),
        ({"entrants": ["a", {"agent": "b"}]}, "entrants[1].name = None: must be given"),
        ({"noise": "loud"}, "noise = 'loud': must be an object"),
        ({"noise": {"levels": [0] * 1001}}, "must be a list of 0 to 1000"),
        ({"noise": {"told": 1}}, "noise.told = 1: must be true or false"),
        ({"sprt": {"alpha": True}}, "sprt.alpha = True: must be a number"),
        ({"sprt": 5}, "sprt = 5: must be an object"),
        ({"seed": True}, "seed = True: must be an integer"),
        ({"seed": 1.5}, "seed = 1.5: must be an integer"),
        ({"table": 3}, "table = 3: must be olympiad"),
        ({"table": {"depth": 1}}, "table."),
        ({"w\n" * 99: 3}, "must be left out; the fields are name"),
    ],
)
def test_what_cannot_be_is_named(change, words):
    with pytest.raises(InvalidSpec) as error:
        Spec.from_dict(WHOLE | change)
    assert words in str(error.value)


@pytest.mark.parametrize("data", [None, [], "x", {}, {"name": "x"}])
def test_what_is_no_event_is_refused(data):
    with pytest.raises(InvalidSpec):
        Spec.from_dict(data)


def test_the_presets_are_the_olympiads_formats_and_the_recommended_one():
    """Noise 1, 5, and variable in [0, 5] with the level told; 300 s; everybody meets everybody."""
    specs = {name: Spec.from_dict(WHOLE | {"preset": name}) for name in PRESETS}
    assert {name: spec.noise for name, spec in specs.items()} == {
        "olympiad-noise-1": NoisePlan((1.0,)),
        "olympiad-noise-5": NoisePlan((5.0,)),
        "olympiad-variable-noise": NoisePlan.variable(0.0, 5.0),
        "nine-foot-noise-2": NoisePlan((2.0,)),
    }
    assert {name: spec.table for name, spec in specs.items() if spec.table != "olympiad"} == {RECOMMENDED: "nine_foot"}
    assert {(spec.format, spec.seconds, spec.noise.told) for spec in specs.values()} == {("round_robin", 300.0, True)}


def test_what_is_given_overrides_the_preset():
    spec = Spec.from_dict(WHOLE | {"preset": "olympiad-noise-5", "seconds": 60.0})
    assert (spec.seconds, spec.noise.levels) == (60.0, (5.0,))


def test_an_event_without_a_seed_repeats_where_no_server_draws_one():
    spec = Spec.from_dict(WHOLE | {"seeding": "drawn", "noise": {"range": [0.0, 5.0]}})
    (pair,) = Tournament(spec).pairs
    assert spec.foreseeable
    assert Tournament(spec.with_seed(0)).pairs == (pair,)
    assert game_seeds(spec, pair, 0) == game_seeds(spec.with_seed(0), pair, 0)
    assert Tournament(spec.with_seed(1)).pairs != (pair,)


def test_lots_draw_order_and_levels_and_nothing_of_racks_and_noise():
    terms = WHOLE | {"seeding": "drawn", "noise": {"range": [0.0, 5.0]}, "lots": "ab" * 32}
    secret = Spec.from_dict(terms)
    (pair,) = Tournament(secret).pairs
    assert not secret.foreseeable
    with pytest.raises(InvalidSpec, match="reveals when the event is over"):
        game_seeds(secret, pair, 0)
    one, other = (Spec.from_dict(terms | {"seed": digits * 32}) for digits in ("cd", "ef"))
    assert Tournament(one).pairs == Tournament(other).pairs == (pair,)
    assert game_seeds(one, pair, 0).noise != game_seeds(other, pair, 0).noise
    assert game_seeds(one, pair, 0).rack_seed != game_seeds(other, pair, 0).rack_seed
    assert Tournament(Spec.from_dict(terms | {"lots": "cd" * 32})).pairs != (pair,)
    told = Spec.from_dict(one.revealed())
    assert (told.seed, told.lots) == (one.seed, one.lots)


def test_published_terms_tell_no_secret():
    spec = Spec("event", (Entrant("a", "python -m secret"), Entrant("b")), seed="5a" * 32, lots="5a" * 32)
    assert spec.published()["foreseeable"] is False
    published = json.dumps(spec.published())
    assert "5a5a" not in published
    assert "secret" not in published
    assert "seed" not in spec.published()


@pytest.mark.parametrize("plan", [NoisePlan((3.0625,), told=False), NoisePlan.variable(3.0625, 3.125, told=False)])
def test_levels_that_are_not_told_are_published_when_the_event_is_over(plan):
    spec = Spec("event", (Entrant("a"), Entrant("b")), noise=plan, seed=5)
    assert spec.published()["noise"] == {"told": False}
    assert spec.revealed()["noise"] == plan.to_dict()
    assert spec.revealed()["seed"] == 5


def test_a_swiss_has_at_most_256_entrants():
    spec_of(256, format="swiss", rounds=1)
    with pytest.raises(InvalidSpec, match="at most 256 in a Swiss"):
        spec_of(257, format="swiss", rounds=1)


@pytest.mark.parametrize("terms", [{}, {"format": "gauntlet", "challengers": 50}, {"format": "knockout"}])
def test_an_event_has_at_most_250000_pairs(terms):
    """The pairs of an event are planned in memory: whoever may send terms must not fill it."""
    with pytest.raises(InvalidSpec, match="at most 250000 pairs of games in an event"):
        spec_of(100, pairs=10_000, **terms)


def test_an_sprt_is_no_knockout():
    with pytest.raises(InvalidSpec, match="no knockout"):
        spec_of(2, format="knockout", sprt=SprtTerms())


@pytest.mark.parametrize("name", sorted(NAMED))
def test_any_named_table_can_be_played_on(name):
    assert Spec.from_dict(WHOLE | {"table": name}).table == name


def test_a_table_is_a_name_and_what_is_changed_of_it():
    """The rest has the named table's value; a change of law brings its constants along."""
    spec = Spec.from_dict(WHOLE | {"table": {"name": "nine_foot", "cushion": "mathavan", "corner_mouth": 0.12}})
    expected = Table.nine_foot().replace(cushion="mathavan", corner_mouth=0.12)
    assert spec.table == expected.to_dict()
    assert Spec.from_dict(spec.to_dict()) == spec
    assert spec.published()["table"] == expected.to_dict()
