"""What is sent, what is sent again, and what is raised: both clients against scripted answers."""

import json
from itertools import repeat
from typing import Any

import httpx2
import pytest

import client
import physics
from client import errors
from protocol import Problem, ProblemCode

AGENTS: dict[str, Any] = {"agents": [], "next_cursor": None}


def problem(status: int, code: ProblemCode, **headers: str) -> httpx2.Response:
    body = Problem.of(code, "because").model_dump_json().encode()
    return httpx2.Response(status, content=body, headers={"Retry-After": "0"} | headers)


def garbled(status: int) -> httpx2.Response:
    """An answer whose body is not in the encoding that its header names."""
    return httpx2.Response(status, headers={"Content-Encoding": "gzip"}, stream=httpx2.ByteStream(b"no gzip"))


def test_the_token_is_sent_with_every_request(make, script):
    answers = script(httpx2.Response(200, json=AGENTS))
    make(token="secret", transport=answers.transport).agents()
    assert answers.requests[0].headers["Authorization"] == "Bearer secret"


def test_without_a_token_nothing_is_claimed(make, script):
    answers = script(httpx2.Response(200, json=AGENTS))
    make(token=None, transport=answers.transport).agents()
    assert "Authorization" not in answers.requests[0].headers


@pytest.mark.parametrize(
    "failure",
    [
        lambda: problem(503, ProblemCode.DRAINING),
        lambda: problem(429, ProblemCode.TOO_MANY_REQUESTS),
        lambda: problem(408, ProblemCode.SLOW_BODY),
        lambda: httpx2.Response(502, text="bad gateway"),
        lambda: httpx2.ConnectError("refused"),
        lambda: httpx2.ReadTimeout("slow"),
        lambda: httpx2.RemoteProtocolError("cut off"),
        lambda: garbled(200),
        lambda: garbled(404),
    ],
    ids=["503", "429", "408", "502", "refused", "slow", "cut-off", "garbled", "garbled-problem"],
)
def test_a_read_is_repeated_after_a_passing_failure(make, script, pauses, failure):
    answers = script(failure(), httpx2.Response(200, json=AGENTS))
    assert make(transport=answers.transport).agents().agents == ()
    assert len(answers.requests) == 2
    assert len(pauses) == 1


def test_a_write_is_repeated_with_one_key(make, script, pauses):
    failures = [httpx2.ReadTimeout("lost")] * 3
    answers = script(*failures, problem(409, ProblemCode.WRONG_STATUS))
    with pytest.raises(errors.WrongStatus):
        make(transport=answers.transport).accept("m1")
    keys = [request.headers["Idempotency-Key"] for request in answers.requests]
    assert len(keys) == 4
    assert len(set(keys)) == 1


def test_an_answer_that_cannot_be_decoded_is_none(make, script):
    """Seen: the exception of the HTTP library came through."""
    answers = script(garbled(201))
    with pytest.raises(errors.ConnectionFailed, match=r"POST /v1/agents.*DecodingError"):
        make(transport=answers.transport).register("me")


def test_two_writes_have_two_keys(make, script):
    answers = script(*[problem(409, ProblemCode.WRONG_STATUS)] * 2)
    api = make(transport=answers.transport)
    for _ in range(2):
        with pytest.raises(errors.WrongStatus):
            api.accept("m1")
    first, second = (request.headers["Idempotency-Key"] for request in answers.requests)
    assert first != second


def test_registration_is_never_repeated(make, script, pauses):
    """Its answer holds a token that is shown once: a second attempt would be another registration."""
    answers = script(httpx2.ReadTimeout("lost"))
    with pytest.raises(errors.ConnectionFailed, match="POST /v1/agents"):
        make(transport=answers.transport).register("me")
    assert len(answers.requests) == 1
    assert pauses == []


def test_a_final_answer_is_not_repeated(make, script, pauses):
    answers = script(problem(404, ProblemCode.NOT_FOUND))
    with pytest.raises(errors.NotFound):
        make(transport=answers.transport).game("g1")
    assert pauses == []


def test_pauses_double_up_to_their_limit_and_never_exceed_it(make, script, pauses):
    answers = script(*[httpx2.ConnectError("refused")] * 8)
    retry = client.Retry(attempts=8, first_pause=0.1, longest_pause=1.0, uniform=lambda: 0.0)
    with pytest.raises(errors.ConnectionFailed):
        make(transport=answers.transport, retry=retry).agents()
    assert pauses == pytest.approx([0.1, 0.2, 0.4, 0.8, 1.0, 1.0, 1.0])


def test_jitter_shortens_a_pause_by_up_to_half():
    error = errors.ConnectionFailed("GET", "/", "refused")
    pauses = [client.Retry(first_pause=1.0, uniform=repeat(u).__next__).pause(1, error) for u in (0.0, 0.5, 1.0)]
    assert pauses == [1.0, 0.75, 0.5]


def test_retry_after_is_the_least_that_is_waited(make, script, pauses):
    answers = script(
        problem(429, ProblemCode.TOO_MANY_REQUESTS, **{"Retry-After": "7"}), httpx2.Response(200, json=AGENTS)
    )
    make(transport=answers.transport).agents()
    assert pauses == [7.0]


def test_a_demand_beyond_patience_is_raised(make, script, pauses):
    answers = script(problem(429, ProblemCode.TOO_MANY_REQUESTS, **{"Retry-After": "3600"}))
    with pytest.raises(errors.TooManyRequests) as caught:
        make(transport=answers.transport).agents()
    assert caught.value.retry_after == 3600.0
    assert pauses == []


@pytest.mark.parametrize("code", list(ProblemCode))
def test_every_problem_code_has_a_class_of_its_own(code):
    """A code without a class would reach the caller as a bare ApiError."""
    request = httpx2.Request("GET", "http://server/v1/x")
    body = Problem.of(code, "because").model_dump_json()
    error = errors.error_of(httpx2.Response(418, content=body, request=request))
    assert type(error).code is code
    assert error.request is request
    assert error.problem is not None
    assert error.problem.detail == "because"
    assert str(code) in str(error)


def test_a_page_that_is_no_problem_document_is_still_an_error():
    request = httpx2.Request("GET", "http://server/v1/x")
    error = errors.error_of(httpx2.Response(500, text="<html>", request=request))
    assert type(error) is errors.ServerError
    assert error.problem is None


def test_the_tree_in_the_docstring_is_the_tree():
    def names(kind):
        own = [child for child in kind.__subclasses__() if child.__module__ == errors.__name__]
        return {kind.__name__} | {name for child in own for name in names(child)}

    drawn = errors.__doc__.replace("│", " ").replace("├──", " ").replace("└──", " ").split()
    assert names(errors.PooliadError) <= set(drawn)


def test_an_answer_of_another_protocol_is_named(make, script):
    answers = script(httpx2.Response(200, json={"hello": "world"}))
    with pytest.raises(errors.UnexpectedAnswer, match="GET /v1/agents"):
        make(transport=answers.transport).agents()


def test_no_message_is_none(make, script):
    answers = script(httpx2.Response(204))
    assert make(transport=answers.transport).turns(wait=5) is None
    assert answers.requests[0].url.query == b"wait=5"


def test_a_long_poll_has_time_to_be_answered(make, script):
    answers = script(httpx2.Response(204))
    make(transport=answers.transport).turns(wait=60)
    assert answers.requests[0].extensions["timeout"]["read"] > 60


@pytest.mark.parametrize(
    ("action", "path", "body"),
    [
        (
            client.Action(shot=physics.Shot(2.0, 90.0, 5.0), call="safety"),
            "shots",
            {
                "shot": {"v": 2.0, "phi": 90.0, "theta": 5.0, "a": 0.0, "b": 0.0},
                "call": "safety",
                "cue_ball": None,
            },
        ),
        (client.Action(decision=client.Decision.ACCEPT_TABLE), "decisions", {"decision": "accept_table"}),
        (client.Action(decision=client.Decision.CONCEDE), "concede", None),
    ],
    ids=["shot", "decision", "concede"],
)
def test_an_action_goes_to_its_address_with_version_and_key(make, script, action, path, body):
    answers = script(problem(412, ProblemCode.STALE_VERSION))
    with pytest.raises(errors.StaleVersion) as caught:
        make(transport=answers.transport).play("g1", 7, action)
    request = answers.requests[0]
    assert request.url.path == f"/v1/games/g1/{path}"
    assert request.headers["If-Match"] == '"7"'
    assert request.headers["Idempotency-Key"]
    assert (json.loads(request.content) if request.content else None) == body
    assert caught.value.view is None
