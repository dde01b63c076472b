"""schemathesis over the whole OpenAPI document, with all its checks, stateful; it runs as the program it is.

By hand, longer: `python -m pytest tests/server/test_schemathesis.py -m long`.
"""

import re
import subprocess
import sys

import pytest

CONFIG = """
# No schema can say that an Idempotency-Key, else optional, is needed where the body names a game.
[[operations]]
include-path-regex = "^/v1/simulate"
checks.positive_data_acceptance.expected-statuses = ["2xx", 400, 401, 403, 404, 409, 412, 422]
checks.negative_data_rejection.expected-statuses = ["4xx"]
checks.missing_required_header.expected-statuses = [400, 401, 403, 404, 428]

# Nor that balls overlap, a ball that may not be called, an agent that is not registered.
[[operations]]
include-method = "POST"
checks.positive_data_acceptance.expected-statuses = ["2xx", 401, 403, 404, 409, 412, 422]
# The order of checks that docs/protocol.md promises: the version goes before the content.
checks.negative_data_rejection.expected-statuses = ["4xx"]
checks.missing_required_header.expected-statuses = [400, 401, 403, 404, 428]

[[operations]]
include-path = "/v1/turns"
parameters = { wait = 0.05 }
"""
UNHURRIED = {f"POOLIAD_{name}": "1e9" for name in ("TOKEN_RATE", "TOKEN_BURST", "ADDRESS_RATE", "ADDRESS_BURST")}
"""No rate stands between the requests and what answers them."""
PROGRAM = (sys.executable, "-c", "from schemathesis.cli import schemathesis; schemathesis()")


def run(folder, url, token, examples, *options):
    """The run's report; the test fails with it unless everything passed."""
    (folder / "schemathesis.toml").write_text(CONFIG)
    command = [
        *(*PROGRAM, "--config-file", str(folder / "schemathesis.toml"), "run", f"{url}/openapi.json"),
        *("--checks", "all", "--max-examples", str(examples), "--seed", "1", "--no-color", "--continue-on-failure"),
        *("--header", f"Authorization: Bearer {token}", *options),
    ]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=3600)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("role", "examples"),
    [("agent", 3), *(pytest.param(role, 200, marks=pytest.mark.long) for role in ("agent", "organiser"))],
)
def test_every_operation_keeps_its_word(own_server, table_at, tmp_path, role, examples):
    """Whatever is sent, the answer is one that the document announces, and never a fault of the server."""
    server = own_server(**UNHURRIED)
    table = table_at(server, games=3)
    table.play(2)
    caller = table.organiser if role == "organiser" else table.players[0]
    report = run(tmp_path, server.url, caller.token, examples)
    operations = int(re.search(r"Selected: (\d+)/\1\n", report)[1])
    assert f"Tested: {operations}" in report
    assert "Traceback" not in server.log
