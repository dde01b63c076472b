"""The SDK against the real server on loopback: every call, and the problems that players meet."""

import threading

import pytest

import client
import physics
from client import errors
from client.http import Pooliad
from protocol import GameOver, MatchOver, NoiseTerms, Turn

TABLE = physics.Table.olympiad()
LEGAL_BREAK = client.Action(shot=physics.Shot(9.0, 270.0, 5.0), cue_ball=(0.558, 1.75))


@pytest.fixture
def pair(hall):
    """Two registered agents, their match, and the first one's turn."""
    first, second = hall.register("first"), hall.register("second")
    match = hall.match(first, second)
    with Pooliad(hall.url, first.token) as mover:
        message = mover.turns(10)
    assert isinstance(message, Turn)
    return first, second, match, message.view


def test_register_list_rotate_and_revoke(make, hall):
    entry = hall.register("someone")
    api = make(hall.url, entry.token)
    listed = {agent.id for agent in _all_agents(api)}
    assert entry.agent.id in listed
    renewed = api.rotate_token(entry.agent.id)
    assert renewed.token != entry.token
    with pytest.raises(errors.Unauthorized):
        api.turns(0)
    fresh = make(hall.url, renewed.token)
    assert fresh.turns(0) is None
    fresh.revoke_token(entry.agent.id)
    with pytest.raises(errors.Unauthorized):
        fresh.turns(0)


def _all_agents(api):
    page = api.agents()
    yield from page.agents
    while page.next_cursor is not None:
        page = api.agents(page.next_cursor)
        yield from page.agents


def test_a_name_is_taken_once(make, hall):
    entry = hall.register("unique")
    with pytest.raises(errors.NameTaken):
        make(hall.url, None).register(entry.agent.name)


def test_challenge_accept_and_abort(make, hall):
    first, second = hall.register("challenger"), hall.register("challenged")
    challenger, challenged = make(hall.url, first.token), make(hall.url, second.token)
    request = client.MatchRequest(agents=(first.agent.id, second.agent.id))
    match = challenger.create_match(request)
    assert match.status == "challenged"
    with pytest.raises(errors.Forbidden):
        challenger.accept(match.id)
    assert challenged.accept(match.id).status == "running"
    with pytest.raises(errors.WrongStatus):
        challenged.accept(match.id)
    assert make(hall.url, hall.organiser_token).abort(match.id).status == "aborted"
    assert match.id in {each.id for each in challenger.matches().matches}
    over = [challenger.turns(0), challenger.turns(0)]
    assert [type(each) for each in over] == [GameOver, MatchOver]


def test_a_stroke_is_played_and_shown(make, hall, pair):
    first, _, match, view = pair
    api = make(hall.url, first.token)
    answer = api.play(view.game, view.version, LEGAL_BREAK)
    assert answer.stroke.shot != answer.stroke.action.shot, "noise 1 leaves no shot as it was"
    assert answer.view.version > view.version
    shown = api.shots(view.game)
    assert [stroke.index for stroke in shown.shots] == [0]
    assert shown.shots[0].events == answer.stroke.events
    assert api.game(view.game).status == "running"
    assert api.match(match.id).played[0].strokes == 1


def test_without_noise_the_server_plays_what_the_library_simulates(make, hall):
    """One physics: the stroke over HTTP ends where `physics.simulate` says, to the last bit."""
    first, second = hall.register("exact"), hall.register("other")
    hall.match(first, second, noise=NoiseTerms(level=0.0))
    api = make(hall.url, first.token)
    view = api.turns(10).view
    answer = api.play(view.game, view.version, LEGAL_BREAK)
    here = physics.simulate(TABLE, view.state.moved(0, LEGAL_BREAK.cue_ball), LEGAL_BREAK.shot)
    assert physics.TableState.from_dict({str(b): p for b, p in answer.stroke.final.items()}) == here.final


def test_a_stale_version_brings_the_current_view(make, hall, pair):
    first, _, _, view = pair
    with pytest.raises(errors.StaleVersion) as caught:
        make(hall.url, first.token).play(view.game, view.version + 1, LEGAL_BREAK)
    assert caught.value.view.version == view.version


def test_out_of_turn_and_not_ones_game(make, hall, pair):
    _, second, _, view = pair
    with pytest.raises(errors.NotYourTurn):
        make(hall.url, second.token).play(view.game, view.version, LEGAL_BREAK)
    with pytest.raises(errors.Forbidden):
        make(hall.url, hall.register("stranger").token).play(view.game, view.version, LEGAL_BREAK)
    with pytest.raises(errors.NotFound):
        make(hall.url, second.token).game("game_nowhere")


def test_a_refusal_says_why_and_changes_nothing(make, hall, pair):
    first, _, _, view = pair
    api = make(hall.url, first.token)
    with pytest.raises(errors.Refused, match="R") as caught:
        api.play(view.game, view.version, client.Action(shot=LEGAL_BREAK.shot, cue_ball=(0.558, 0.3)))
    assert caught.value.problem.field == "cue_ball"
    assert api.turns(0).view.version == view.version


def test_conceding_ends_the_game_and_reveals_the_record(make, hall, pair):
    first, second, _, view = pair
    api = make(hall.url, first.token)
    with pytest.raises(errors.GameUnfinished):
        api.record(view.game)
    api.play(view.game, view.version, client.Action(decision=client.Decision.CONCEDE))
    with pytest.raises(errors.GameFinished):
        api.play(view.game, view.version, LEGAL_BREAK)
    assert api.record(view.game).count(b"\n") >= 2
    over = make(hall.url, second.token).turns(10)
    assert isinstance(over, GameOver)
    assert over.won is True
    assert over.outcome.reason == "concession"


def test_the_physics_answers_over_http_as_in_process(make, hall):
    state = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})
    api = make(hall.url, hall.register("physicist").token)
    theta = api.min_elevation(TABLE, state, 260.0).theta
    assert theta == physics.min_elevation(TABLE, state, 260.0)
    shot = physics.Shot(2.0, 260.0, theta + 1.0)
    here = physics.simulate(TABLE, state, shot)
    there = api.simulate(TABLE, state, shot)
    assert len(there.events) == len(here.events)
    assert {str(ball): list(place) for ball, place in there.balls.items()} == here.final.to_dict()
    assert api.simulate(TABLE, state, shot, trace=False).events is None
    rows = api.simulate_batch(TABLE, state, [shot, shot.replace(phi=261.0)]).results
    assert rows[0].balls == there.balls
    assert rows[1].balls != there.balls


def test_a_long_poll_returns_when_the_turn_comes(make, hall, pair):
    first, second, _, view = pair
    answers = []
    waiting = threading.Thread(target=lambda: answers.append(make(hall.url, second.token).turns(20)))
    waiting.start()
    with Pooliad(hall.url, first.token) as mover:
        mover.play(view.game, view.version, client.Action(decision=client.Decision.CONCEDE))
    waiting.join(15)
    assert isinstance(answers[0], GameOver)
