"""`client.Pooliad` and `client.AsyncPooliad` are `client.calls`, sent: the same methods, parameters, answers, types."""

import inspect
import subprocess
import sys
from typing import get_args

import pytest
from support.require import ROOT, require

import client
from client import calls
from client.exchange import ApiCall

CALLS = {
    name: each
    for name, each in vars(calls).items()
    if inspect.isfunction(each)
    and each.__module__ == calls.__name__
    and "ApiCall[" in str(each.__annotations__["return"])
}
"""Every function that makes a request."""

TYPED = """
from typing import assert_type

from client import Action, AsyncPooliad, MatchRequest, Pooliad
from protocol import AgentList, AgentToken, MatchView, MinimalAnswer, StrokeAnswer


def sync(api: Pooliad, action: Action) -> None:
    assert_type(api.agents(house=True), AgentList)
    assert_type(api.register("x", invitation="y"), AgentToken)
    assert_type(api.play("g", 1, action, simulated=3), StrokeAnswer)
    assert_type(api.act("g", 1, action, simulated=3), MinimalAnswer)
    assert_type(api.record("g"), bytes)


async def asynchronous(api: AsyncPooliad, request: MatchRequest) -> None:
    assert_type(await api.agents(house=True), AgentList)
    assert_type(await api.create_match(request), MatchView)
"""
WRONG = """
from client import Action, AsyncPooliad, Pooliad


async def wrong(api: Pooliad, other: AsyncPooliad, action: Action) -> None:
    api.agents(True)
    api.play("g", "1", action)
    await other.create_match()
"""


def public(kind):
    return {name for name, each in vars(kind).items() if inspect.isfunction(each) and not name.startswith("_")}


def test_every_call_is_a_method_of_both():
    assert len(CALLS) > 30
    assert public(client.Pooliad) == public(client.AsyncPooliad) == {*CALLS, "close"}


@pytest.mark.parametrize("name", CALLS)
def test_a_method_says_what_its_call_says(name):
    sync, asynchronous = (getattr(kind, name) for kind in (client.Pooliad, client.AsyncPooliad))
    assert inspect.signature(sync) == inspect.signature(asynchronous)
    assert sync.__doc__ == asynchronous.__doc__ == CALLS[name].__doc__
    assert inspect.iscoroutinefunction(asynchronous)
    assert not inspect.iscoroutinefunction(sync)
    (itself, *parameters), wanted = inspect.signature(sync).parameters.values(), inspect.signature(CALLS[name])
    assert itself.name == "self"
    assert parameters == list(wanted.parameters.values())
    assert inspect.signature(sync).return_annotation == get_args(wanted.return_annotation)[0]
    assert wanted.return_annotation.__origin__ is ApiCall


@pytest.mark.parametrize(
    ("program", "wrong"), [pytest.param(TYPED, 0, marks=pytest.mark.slow), (WRONG, 3)], ids=["right", "wrong"]
)
def test_a_type_checker_knows_arguments_and_answers(tmp_path, program, wrong):
    require(subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode == 0, "mypy")
    file = tmp_path / "program.py"
    file.write_text(program)
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file", str(ROOT / "pyproject.toml"), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    assert done.stdout.count(": error: ") == wrong, done.stdout
