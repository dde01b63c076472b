"""A recorded stroke as something that simulates it again, for bug reports: a program, a request, a command line."""

import json
import shlex
from collections.abc import Mapping
from enum import StrEnum
from typing import Any


class Form(StrEnum):
    """What it is written as."""

    PYTHON = "python"
    JSON = "json"
    CURL = "curl"


def reproduction(header: Mapping[str, Any], entry: Mapping[str, Any], form: Form) -> str:
    """The stroke as played, noise included, on the table as it lay; it ends as the record says, bit for bit.

    `json` is the body of `POST /v1/simulate`, `curl` the request, with the server in `$URL` and a token in `$TOKEN`.
    """
    from physics import Shot, Table, TableState

    table = Table.from_dict(header["table"])
    state, shot = TableState.from_dict(entry["before"]), Shot.from_dict(entry["shot"])
    body = {"table": _table_value(table), "balls": state.to_dict(), "shot": shot.to_dict(), "trace": True}
    match form:
        case Form.PYTHON:
            return _program(table, state, shot)
        case Form.JSON:
            return json.dumps(body)
        case Form.CURL:
            headers = '-H "Authorization: Bearer $TOKEN" -H "Content-Type: application/json"'
            return f'curl -sS --fail-with-body "$URL/v1/simulate" {headers} -d {shlex.quote(json.dumps(body))}'


def _table_value(table: Any) -> str | dict[str, Any]:
    """A shipped table by its name, another in full."""
    from physics import Table

    named = Table.from_dict({"name": table.name})
    values: dict[str, Any] = table.to_dict()
    return str(table.name) if named == table else values


def _program(table: Any, state: Any, shot: Any) -> str:
    """A Python program."""
    from client import notation

    value = _table_value(table)
    made = f"physics.Table.{value}()" if isinstance(value, str) else f"physics.Table.from_dict({value!r})"
    return f"""import physics
from client import notation

table = {made}
state = notation.read({notation.write(state)!r})
shot = physics.Shot(v={shot.v!r}, phi={shot.phi!r}, theta={shot.theta!r}, a={shot.a!r}, b={shot.b!r})
result = physics.simulate(table, state, shot)
for event in result.events:
    print(event)
print(notation.write(result.final))"""
