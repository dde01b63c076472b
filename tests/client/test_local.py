"""`client.play`: whole matches without a server."""

import logging
import traceback
from typing import Any

import pytest

import client
import physics
from client.errors import AgentFailed, AgentUnstartable
from client.local import over_message
from client.local_game import play_game
from client.session import AgentSession
from referee import EightBall, MatchSeed, NoiseModel
from referee.record import verify_record

CONCEDE = client.Action(decision=client.Decision.CONCEDE)


class Conceding(client.Agent):
    """Gives up at once."""

    def choose(self, view):
        return CONCEDE


class Hopeless(client.Agent):
    """Never answers with an action."""

    def choose(self, view):
        raise LookupError("no idea")


def test_the_same_seed_plays_the_same_match():
    once, again = (client.play("random", "random", seed=11) for _ in range(2))
    assert list(once.games[0].record()) == list(again.games[0].record())
    other = client.play("random", "random", seed=12)
    assert list(other.games[0].record()) != list(once.games[0].record())


def test_the_break_alternates_and_points_add_up():
    match = client.play(Conceding, Conceding, games=4, seed=1)
    breakers = [game.header.start.breaker for game in match.games]
    assert breakers in ([0, 1, 0, 1], [1, 0, 1, 0])
    assert match.score == (2.0, 2.0)
    assert match.winner is None
    assert match.players == ("Conceding-1", "Conceding-2")


def test_an_agent_that_never_acts_forfeits_with_its_reasons_logged(caplog):
    with caplog.at_level(logging.ERROR, "pooliad.agent"):
        match = client.play(Hopeless, "random", seed=2, strict=False)
    assert match.games[0].outcome.reason == "forfeit"
    assert match.winner == "random"
    assert len(caplog.records) == 20
    assert "no idea" in caplog.records[0].exc_text


def test_the_same_exception_three_times_ends_the_match_with_the_agents_traceback():
    """Seen: an agent with a slip in it forfeited after twenty tracebacks, and `play` returned as if it had played."""
    asked = []

    class Slips(Hopeless):
        def choose(self, view):
            asked.append(view)
            return super().choose(view)

    with pytest.raises(
        AgentFailed, match=r"Slips \(seat 0\) raised the same exception 3 times.*no idea.*strict=False"
    ) as e:
        client.play(Slips, "random", seed=2)
    assert len(asked) == 3
    assert isinstance(e.value.__cause__, LookupError)
    shown = "".join(traceback.format_exception(e.value))
    assert 'raise LookupError("no idea")' in shown


def test_exceptions_of_other_lines_are_others_and_an_answer_between_them_does_not_matter():
    """The count is of the match: an agent that fails in every game fails a third time in the third."""

    class FailsOnceAGame(Conceding):
        def choose(self, view):
            if not hasattr(self, "failed"):
                self.failed = True
                if view.number % 2:
                    raise LookupError("in odd games")
                raise LookupError("in even games")
            return CONCEDE

    both = client.play(FailsOnceAGame, FailsOnceAGame, games=4, seed=1)
    assert len(both.games) == 4
    with pytest.raises(AgentFailed, match="in even games"):
        client.play(FailsOnceAGame, FailsOnceAGame, games=12, seed=1)


@pytest.mark.parametrize("strict", [True, False])
def test_an_agent_that_cannot_be_made_ends_the_match_before_it_begins(strict):
    class NoModel(Conceding):
        def __init__(self):
            raise FileNotFoundError("model.bin")

    strokes: list[Any] = []
    for pair in ((NoModel, "random"), ("random", NoModel)):
        with pytest.raises(AgentUnstartable, match=r"cannot be made: FileNotFoundError: model.bin") as caught:
            client.play(*pair, seed=2, strict=strict, on_stroke=strokes.append)
        assert isinstance(caught.value.__cause__, FileNotFoundError)
    assert strokes == []


@pytest.fixture(scope="module")
def opening():
    """The view of a break."""
    seen = []

    class Looks(Conceding):
        def choose(self, view):
            seen.append(view)
            return CONCEDE

    client.play(Looks, Looks, seed=1)
    return seen[0]


@pytest.mark.parametrize(
    ("azimuths", "doubts"),
    [
        ((4.712, 1.571, 0.785, 3.99, 2.222, 0.123), 1),
        ((4.712, 1.571, 0.785, 96.2), 0),
        ((1.5, 2.0, 3.0, 0.1), 0),
        ((4.712, 4.712, 4.712, 4.712), 0),
    ],
)
def test_azimuths_that_look_like_radians_are_doubted_once_a_game(opening, caplog, azimuths, doubts):
    """Four directions within 2 pi, none of them round, are no directions in degrees: one in 600,000 is by chance."""

    class Aims(client.Agent):
        left = iter(azimuths)

        def choose(self, view):
            return client.Action(shot=physics.Shot(1.0, next(self.left)))

    session = AgentSession(Aims)
    for _ in azimuths:
        session.ask(opening)
    found = [record.getMessage() for record in caplog.records if getattr(record, "kind", "") == "radians"]
    assert len(found) == doubts
    assert all("4.71, 1.57, 0.785, 3.99: must be in degrees" in words for words in found)


def test_hooks_and_one_instance_a_game():
    told = []

    class Diary(client.Agent):
        def __init__(self):
            self.views = 0

        def game_started(self, view):
            self.views += 1

        def choose(self, view):
            assert self.views == 1
            return CONCEDE

        def game_over(self, over):
            told.append((over.number, over.seat, over.won, over.score, over.view.outcome.reason))

    client.play(Diary, "random", games=2, seed=3)
    assert [number for number, *_ in told] == [0, 1]
    assert told[-1][3] == (0.0, 2.0)
    assert {(seat, won, reason) for _, seat, won, _, reason in told} == {(0, False, "concession")}


def test_a_fault_in_a_hook_does_not_stop_the_match(caplog):
    class Fragile(Conceding):
        def game_over(self, over):
            raise RuntimeError("in the hook")

    match = client.play(Fragile, "random", seed=4)
    assert match.winner == "random"
    assert "in the hook" in caplog.text


def test_a_local_record_verifies(tmp_path):
    record = tmp_path / "game.jsonl"
    record.write_text("\n".join(client.play("random", "random", seed=5).games[0].record()) + "\n")
    assert verify_record(record).ok


@pytest.mark.parametrize("told", [True, False])
def test_the_seed_of_noise_that_is_not_told_is_in_no_message(told):
    """It was, so that an entrant of an event knew the level of every game after its first."""
    seen = []

    def concede(view):
        seen.append(view)
        return client.Action(decision=client.Decision.CONCEDE)

    rules, noise = EightBall(physics.Table.olympiad()), NoiseModel(2.0, told)
    game = play_game(rules, (concede, concede), MatchSeed.of(3).game(0), noise)
    message = over_message(game, 0, seen[-1], (0.0, 1.0))
    assert message.noise_seed == (game.seeds.noise_seed.hex() if told else None)
    assert message.view.noise.level == (2.0 if told else None)


def test_noise_and_table_are_those_asked_for():
    table = physics.Table.olympiad().replace(mu_slide=0.25)
    strokes: list[Any] = []
    match = client.play("random", "random", seed=6, noise=0.0, table=table, on_stroke=strokes.append)
    assert match.games[0].header.terms.rules.table == table
    shots = [stroke for stroke in strokes if stroke.shot is not None]
    assert all(stroke.shot == stroke.action.shot for stroke in shots)
    assert len(strokes) == len(match.games[0].strokes)


@pytest.mark.parametrize("games", [0, -1, True, 1.5, "2"])
def test_a_match_has_at_least_one_game(games):
    with pytest.raises(ValueError, match="games = "):
        client.play(Conceding, Conceding, games=games)


@pytest.mark.parametrize("name", ["nobody", "no.such.module:Agent", "client:Pooliad", "client:Nothing"])
def test_an_agent_that_cannot_be_found_is_named(name):
    with pytest.raises(client.PooliadError, match=name.partition(":")[0]):
        client.load(name)


def test_an_agent_goes_by_import_path(monkeypatch, tmp_path):
    (tmp_path / "my_agents.py").write_text(
        "import client\n\n\nclass Mine(client.Agent):\n    def choose(self, view):\n"
        "        return client.Action(decision='concede')\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    assert client.play("my_agents:Mine", "random", seed=7).players == ("Mine", "random")
