"""What the proxy itself answers: problems in the server's place, fields that no agent knows."""

import json

import httpx2

from client.compliance.situations import Twist
from protocol import PROBLEM_JSON, Problem, ProblemCode

RETRY_AFTER = 1
"""Seconds of patience that the twist `draining` asks for."""


def problem_of(twist: Twist, path: str) -> httpx2.Response:
    """What the proxy says in the server's place."""
    code, words = ProblemCode.DRAINING, "the server is shutting down"
    headers = {"Retry-After": str(RETRY_AFTER)}
    if twist is Twist.REFUSED:
        code, words = ProblemCode.REFUSED, "refused to see what happens; try again"
        headers = {}
    return rendered(Problem.of(code, words, instance=path), headers)


def rendered(problem: Problem, headers: dict[str, str]) -> httpx2.Response:
    """A problem as a server sends it."""
    content = problem.model_dump_json(exclude_unset=True).encode()
    return httpx2.Response(problem.status, content=content, headers={"Content-Type": PROBLEM_JSON} | headers)


def with_new_fields(response: httpx2.Response) -> httpx2.Response:
    """The answer with a field that no agent knows, at its top and in its view."""
    try:
        content = json.loads(response.content)
    except ValueError:
        return response
    if not isinstance(content, dict):
        return response
    for part in (content, content.get("view")):
        if isinstance(part, dict):
            part["introduced_later"] = {"nested": [1, "two", None]}
    headers = {name: value for name, value in response.headers.items() if name != "content-length"}
    return httpx2.Response(response.status_code, content=json.dumps(content).encode(), headers=headers)
