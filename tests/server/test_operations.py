"""For whoever runs the server: docs/operations.md."""

import json
import logging
import re
import time

import pytest
from prometheus_client.parser import text_string_to_metric_families
from support.require import ROOT
from support.server_time import Stage

from physics.self_test import SelfTest, self_test
from referee.record import this_engine
from server.errors import Draining
from server.ops.logs import REQUEST, JsonLines
from server.ops.metrics import Metrics
from server.routes.health import readiness
from server.services.runtime import warmup
from server.settings import settable
from server.store.upgrade import head

PAGE = (ROOT / "docs" / "operations.md").read_text(encoding="utf-8")


def samples(server):
    """Every sample of /metrics by name and labels."""
    response = server.request("GET", "/metrics")
    assert response.status_code == 200
    assert response.headers["content-type"].startswith("text/plain; version=0.0.4")
    families = text_string_to_metric_families(response.text)
    return {
        (sample.name, tuple(sorted(sample.labels.items()))): sample.value
        for family in families
        for sample in family.samples
    }


def value(found, name, **labels):
    return found.get((name, tuple(sorted(labels.items()))), 0.0)


def lines_of(server, message):
    """The log's lines with this message."""
    lines = [json.loads(line) for line in server.log.splitlines() if line.startswith("{")]
    return [line for line in lines if line["message"] == message]


def logged(server, request):
    """The line about a request: it is written when the answer has been sent."""
    for _ in range(100):
        for line in lines_of(server, "request"):
            if line["request"] == request:
                return line
        time.sleep(0.05)
    raise AssertionError(f"no line about {request}:\n{server.log}")


def test_metrics_count_requests_strokes_and_ends(own_server, table_at):
    server = own_server()
    table = table_at(server)
    table.play(2)
    mover, view = table.mover()
    mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
    found = samples(server)
    assert value(found, "pooliad_strokes_total") == 3
    assert value(found, "pooliad_stroke_seconds_count") == 3
    assert value(found, "pooliad_games_ended_total", reason="concession") == 1
    assert value(found, "pooliad_games_running") == 0
    shots = value(found, "pooliad_requests_total", method="POST", route="/v1/games/{game_id}/shots", status="200")
    chosen = {"method": "POST", "route": "/v1/games/{game_id}/decisions", "status": "200"}
    decisions = value(found, "pooliad_requests_total", **chosen)
    assert shots + decisions == 2
    assert value(found, "process_resident_memory_bytes") > 0


def test_what_clients_invent_makes_no_new_series(own_server):
    server = own_server()
    for number in range(20):
        server.request("GET", f"/nowhere/{number}")
        server.request(f"VERB{number}", "/healthz")
    routes = {dict(labels)["route"] for name, labels in samples(server) if name == "pooliad_requests_total"}
    methods = {dict(labels)["method"] for name, labels in samples(server) if name == "pooliad_requests_total"}
    assert not any("nowhere" in route for route in routes)
    assert not any("VERB" in method for method in methods)


def test_every_metric_is_in_the_documentation(own_server):
    text = own_server().request("GET", "/metrics").text
    names = {family.name for family in text_string_to_metric_families(text)}
    ours = {name.removesuffix("_created") for name in names if name.startswith("pooliad_")}
    assert ours == set(re.findall(r"^\| `(pooliad_\w+)`", PAGE, re.MULTILINE))


def test_two_apps_in_one_process_count_apart():
    one, other = Metrics(), Metrics()
    one.strokes.inc()
    assert other.strokes._value.get() == 0.0


def test_the_log_is_json_lines_with_the_ids_of_request_game_and_shot(own_server, table_at):
    server = own_server()
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    shot = {"v": 9.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}
    body = {"shot": shot, "call": None, "cue_ball": [0.558, 1.8]}
    headers = {"X-Request-Id": "my-request.1", "Idempotency-Key": "k", "If-Match": "1"}
    response = mover.request("POST", f"/v1/games/{view['game']}/shots", json=body, headers=headers)
    assert response.headers["x-request-id"] == "my-request.1"
    (stroke,) = lines_of(server, "stroke")
    assert (stroke["request"], stroke["game"], stroke["shot"]) == ("my-request.1", view["game"], f"{view['game']}/0")
    request = logged(server, "my-request.1")
    assert (request["method"], request["status"], request["game"]) == ("POST", 200, view["game"])
    assert {"time", "level", "logger", "seconds"} <= set(request)
    assert mover.token not in server.log


@pytest.mark.parametrize("sent", [None, "", "with space", "x" * 65, "ü", '"}{'])
def test_a_request_id_that_cannot_be_used_is_replaced(server, sent):
    headers = [] if sent is None else [(b"X-Request-Id", sent.encode())]
    answered = server.request("GET", "/healthz", headers=headers).headers["x-request-id"]
    assert re.fullmatch(r"[0-9a-f]{16}", answered)


def test_a_fault_is_a_line_with_its_traceback_and_whatever_is_logged_stays_one_line():
    try:
        raise RuntimeError("two\nlines")
    except RuntimeError:
        record = logging.LogRecord(
            "x", logging.ERROR, __file__, 1, "bad\n%s", ("\u2028",), __import__("sys").exc_info()
        )
    record.fields = {"game": "g", "shot": "g/1", "odd": {1, 2}}
    token = REQUEST.set("r1")
    line = JsonLines().format(record)
    REQUEST.reset(token)
    assert "\n" not in line
    read = json.loads(line)
    assert (read["game"], read["shot"], read["request"], read["level"]) == ("g", "g/1", "r1", "error")
    assert "RuntimeError: two" in read["exception"]


def test_ready_names_engine_self_test_database_and_schema(server):
    end = time.monotonic() + 120
    while (response := server.request("GET", "/readyz")).status_code == 503 and time.monotonic() < end:
        time.sleep(0.2)
    ready = response.json()
    assert ready["engine"] == this_engine().digest
    assert ready["self_test"] == self_test().digest
    assert ready["schema"] == head()
    assert ready["database"] in ("sqlite", "postgresql")


def test_physics_that_contradicts_itself_is_not_ready(tmp_path, monkeypatch, caplog):
    stage = Stage(tmp_path / "ready.db")
    wrong = SelfTest(ok=False, digest="0" * 64, events=1)
    monkeypatch.setattr(warmup, "self_test", lambda jaws: wrong)
    stage.context.kernels.straight.start()
    assert stage.context.kernels.straight.failed.wait(30)
    with pytest.raises(Draining):
        readiness(stage.context)
    assert "two answers" in caplog.text
    stage.close()


def test_the_table_of_settings_is_the_settings():
    written = re.findall(r"^\| `(\w+)` \| (\S+) \| (.+) \|$", PAGE, re.MULTILINE)
    expected = [(each.name, f"`{shown(each.default)}`", each.metadata["words"]) for each in settable()]
    assert [row for row in written if not row[0].startswith("pooliad_")] == expected


def shown(default):
    return (
        {"": '""', True: "true", False: "false"}.get(default, default) if isinstance(default, bool | str) else default
    )
