"""Strokes on the wire, from real shots: nothing is lost, and a view shows what its reader missed."""

import json
import re

import pytest
from support.players import Potter

from client.local_game import play_game
from physics import Shot, Table
from protocol import ShotsPage, StrokeDetail, StrokeView, View
from protocol.strokes import since_own_last
from referee.game import Action, Decision
from referee.play import MatchSeed, NoiseModel, play_stroke, start_game
from referee.record import canonical, stroke_entry
from referee.rules import EightBall
from server.services.play.stored_strokes import is_decision

RULES = EightBall(Table.olympiad())
NOISE = NoiseModel(1.0)


@pytest.fixture(scope="module")
def strokes():
    players = (Potter("a"), Potter("b"))
    return play_game(RULES, players, MatchSeed.of(1).game(0), NOISE).strokes


def test_a_stroke_survives_json_with_every_event(strokes):
    for index, stroke in enumerate(strokes):
        detail = StrokeDetail.of(stroke, index)
        text = detail.model_dump_json()
        assert StrokeDetail.model_validate_json(text) == detail
        assert detail.action.to_action() == stroke.action
        if stroke.result is None:
            assert (detail.shot, detail.events, detail.final) == (None, (), None)
            continue
        sent = json.loads(text)
        assert detail.shot.to_shot() == stroke.shot
        assert sent["events"] == [event.to_dict() for event in stroke.result.events]
        assert sent["final"] == stroke.result.final.to_dict()
        assert sent["before"] == stroke.before.to_dict()
        assert sent["balls"] == stroke.game.state.to_dict()
        assert [(ball["ball"], ball["pocket"]) for ball in sent["pocketed"]] == [
            (ball, pocket) for ball, pocket, _ in stroke.result.facts.pocketed_in_order
        ]


@pytest.mark.parametrize("table", [Table.olympiad(), Table.nine_foot()], ids=["olympiad", "nine_foot"])
def test_the_line_of_a_record_says_all_that_players_are_told(table):
    """The server stores strokes once: what views and histories show is the same, but for the sign of zeros.

    RFC 8785 writes -0 as 0 (section 3.2.2.3); the events of histories have always been those of the line.
    """
    counted = 0
    for seed in range(4):
        played = play_game(EightBall(table), (Potter("a"), Potter("b")), MatchSeed.of(seed).game(0), NOISE).strokes
        for index, stroke in enumerate(played):
            entry = json.loads(canonical(stroke_entry(stroke, index)))
            for kind in (StrokeView, StrokeDetail):
                told = kind.of(stroke, index).model_dump_json()
                assert kind.of_entry(entry).model_dump_json() == re.sub(r"-0\.0(?=[,\]}])", "0.0", told)
            counted += stroke.result is not None and bool(stroke.result.facts.pocketed_in_order)
            assert is_decision(canonical(stroke_entry(stroke, index))) == (stroke.result is None)
    assert counted > 10


def test_a_ruling_on_the_wire_says_what_the_referee_said(strokes):
    for index, stroke in enumerate(strokes):
        ruling = json.loads(StrokeView.of(stroke, index).model_dump_json(exclude_defaults=True))["ruling"]
        said = stroke.ruling.to_dict()
        assert ruling == {key: said[key] for key in ruling}
        assert {"rules", "fouls", "words", "evidence", "made", "rerack", "turn"} <= set(ruling)


def test_a_view_of_a_stroke_is_the_detail_without_events(strokes):
    for index, stroke in enumerate(strokes[:5]):
        detail = StrokeDetail.of(stroke, index).model_dump(mode="json")
        view = StrokeView.of(stroke, index).model_dump(mode="json")
        assert detail == view | {key: detail[key] for key in ("before", "final", "events")}


def test_a_page_of_history_survives_json(strokes):
    shots = tuple(StrokeDetail.of(stroke, index) for index, stroke in enumerate(strokes[:3]))
    page = ShotsPage(shots=shots, next_cursor=3)
    assert ShotsPage.model_validate_json(page.model_dump_json()) == page


def test_views_of_a_whole_game_survive_json_and_allow_what_the_referee_allows():
    views = []

    def spy(player):
        def choose(view):
            views.append(view)
            return player(view)

        return choose

    seeds = MatchSeed.of(6).game(0)
    play_game(RULES, (spy(Potter("a")), spy(Potter("b"))), seeds, NOISE)
    for view in views:
        read = View.model_validate_json(view.model_dump_json())
        assert read == view
        legal = RULES.legal(read.to_game())
        assert legal.turn == view.seat
        assert (legal.actions, legal.callable, legal.decisions) == (
            view.allowed.actions,
            view.callable_balls,
            view.allowed.decisions,
        )


def test_what_a_reader_missed(strokes):
    history = [StrokeView.of(stroke, index) for index, stroke in enumerate(strokes[:12])]
    seats = [stroke.seat for stroke in history]
    assert since_own_last([], 0) == ()
    assert since_own_last(history, None) == (history[-1],)
    for seat in (0, 1):
        last = len(seats) - 1 - seats[::-1].index(seat)
        assert since_own_last(history, seat) == tuple(history[last:])
    start = seats.index(1 - seats[0])
    assert since_own_last(history[:start], 1 - seats[0]) == tuple(history[:start])


def test_a_decision_has_no_stroke_index():
    seeds = MatchSeed.of(1).game(0)
    soft = Action(Shot(0.3, 270.0, 5.0), cue_ball=(0.558, 1.75))
    first = play_stroke(RULES, start_game(RULES, seeds), soft, seeds, NOISE)
    second = play_stroke(RULES, first.game, Action(decision=Decision.ACCEPT_TABLE), seeds, NOISE)
    view = StrokeView.of(second, 1)
    assert (view.index, view.stroke, view.shot, view.status, view.pocketed) == (1, None, None, None, ())
    assert view.action.decision == "accept_table"
