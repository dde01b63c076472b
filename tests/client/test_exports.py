"""The public surface of `client`, and what importing it costs."""

import subprocess
import sys

import pytest

import client


def test_everything_exported_exists():
    assert set(client.__all__) == {
        "SAFETY",
        "Action",
        "Agent",
        "AgentFactory",
        "AsyncPooliad",
        "BudgetSpent",
        "Call",
        "Decision",
        "GameOver",
        "LocalMatch",
        "MatchRequest",
        "Pooliad",
        "PooliadError",
        "Retry",
        "Simulator",
        "View",
        "load",
        "play",
        "run_agent",
        "serve_agent",
        "spar",
    }
    assert all(getattr(client, name) is not None for name in client.__all__)
    assert set(client.__all__) <= set(dir(client))


def test_an_unknown_name_is_an_attribute_error_that_helps():
    with pytest.raises(AttributeError, match="run_agent"):
        client.run_agents  # noqa: B018


def test_using_the_sdk_loads_no_compiler():
    """Contract: importing `client` loads neither numba nor scipy; kernels load at the first simulation."""
    program = (
        "import sys, client; client.Pooliad('http://x'); client.Agent, client.run_agent, client.play;"
        "client.load('random');"
        "print([name for name in ('numba', 'scipy', 'server', 'fastapi') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
