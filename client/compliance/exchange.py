"""A request and its answer, as the agent saw them."""

import json
from dataclasses import dataclass

ACTIONS = ("shots", "decisions", "concede")


@dataclass(frozen=True, slots=True)
class Exchange:
    """A request and its answer, as the agent saw them.

    Attributes:
        at: when the request was complete, s, by `time.monotonic`. done: when it was answered, likewise.
        method, path, query, headers, body: of the request; header names in lower case.
        status: of the answer; 0 when the connection was cut.
        code: of the problem, if it was one. answer: the body.
        twisted: whether the answer is the proxy's and not the server's.
    """

    at: float
    done: float
    method: str
    path: str
    query: str
    headers: dict[str, str]
    body: bytes
    status: int
    code: str | None
    answer: bytes
    twisted: bool

    @property
    def is_action(self) -> bool:
        """Whether it was an action in a game."""
        return self.method == "POST" and self.path.rpartition("/")[2] in ACTIONS

    @property
    def game(self) -> str:
        """The game it was about; empty for none."""
        parts = self.path.split("/")
        return parts[3] if len(parts) > 3 and parts[2] == "games" else ""


def code_of(status: int, answer: bytes) -> str | None:
    """The code of the problem in an answer; None when it reports success, or no code."""
    if status < 400:
        return None
    try:
        return str(json.loads(answer)["code"])
    except (ValueError, KeyError, TypeError):
        return None
