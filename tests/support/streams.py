"""Server-sent events, read by the standard's rules (https://html.spec.whatwg.org/multipage/server-sent-events.html)."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import pytest


@dataclass
class Told:
    """One event of a stream; a comment has no kind."""

    kind: str
    data: Any
    id: str | None


def told(lines: Iterator[str]) -> Iterator[Told]:
    """Events by the standard's rules, each as soon as its empty line is there."""
    fields: dict[str, list[str]] = {}
    for line in lines:
        if line:
            name, _, value = line.partition(":")
            fields.setdefault(name, []).append(value.removeprefix(" "))
            continue
        kind = fields.get("event", [""])[-1]
        if kind or "" in fields:
            data = json.loads("\n".join(fields["data"])) if "data" in fields else None
            yield Told(kind, data, fields.get("id", [None])[-1])
        fields = {}


@contextmanager
def watching(server: Any, path: str, **headers: str) -> Iterator[Iterator[Told]]:
    with server.http.stream("GET", path, headers=headers, timeout=30) as response:
        assert response.status_code == 200, response.read()
        assert response.headers["content-type"].partition(";")[0] == "text/event-stream"
        yield told(response.iter_lines())


def until(events: Iterator[Told], kind: str, count: int = 1) -> list[Told]:
    """Everything up to the `count`-th event of a kind."""
    seen: list[Told] = []
    for event in events:
        seen.append(event)
        count -= event.kind == kind
        if count == 0:
            return seen
    pytest.fail(f"the stream ended before the {kind}: {[event.kind for event in seen]}")


def kinds(events: list[Told]) -> list[str]:
    return [event.kind for event in events]
