"""SIGTERM (docs/operations.md, "Stopping"): open polls and streams, a stroke on its way, a body that never ends."""

import json
import signal
import socket
import time
from contextlib import ExitStack

import pytest

WAITING = 8
CHUNKS_END = b"0\r\n\r\n"
"""RFC 9112, 7.1: an answer in chunks without it was cut off."""


@pytest.fixture
def sent():
    """Makes a connection with a request on it, its body announced and perhaps not complete."""
    with ExitStack() as made:

        def send(server, head="", body=b"", length=None):
            connection = made.enter_context(socket.create_connection(("127.0.0.1", server.port), timeout=60))
            lengths = "" if length is None else f"Content-Length: {length}\r\n"
            connection.sendall((head and f"{head}\r\nHost: x\r\n{lengths}\r\n").encode() + body)
            return connection

        yield send


def rest(connection):
    """What is read until the server closes."""
    return b"".join(iter(lambda: connection.recv(65536), b""))


def answer_on(connection):
    """Head and body."""
    head, _, body = rest(connection).partition(b"\r\n\r\n")
    return head.decode().lower(), body


def beginning(connection, text):
    """Read on until this was said."""
    said = b""
    while text not in said:
        said += connection.recv(65536)


def ready(server):
    end = time.monotonic() + 120
    while server.request("GET", "/readyz").status_code != 200:
        assert time.monotonic() < end
        time.sleep(0.1)


def stroke_of(mover, view, break_shot):
    body = json.dumps(break_shot).encode()
    head = (
        f"POST /v1/games/{view['game']}/shots HTTP/1.1\r\nAuthorization: Bearer {mover.token}\r\n"
        f'Content-Type: application/json\r\nIdempotency-Key: last\r\nIf-Match: "{view["version"]}"'
    )
    return head, body


@pytest.mark.slow
def test_everybody_is_told_and_the_server_ends(own_server, table_at, player_at, break_shot, sent):
    server = own_server(POOLIAD_DRAIN_SECONDS="2")
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    head, body = stroke_of(mover, view, break_shot)
    ready(server)
    waiting = [player_at(server) for _ in range(WAITING)]
    polls = [
        sent(server, f"GET /v1/turns?wait=60 HTTP/1.1\r\nAuthorization: Bearer {player.token}") for player in waiting
    ]
    streams = [sent(server, f"GET /v1/games/{view['game']}/stream HTTP/1.1") for _ in range(WAITING)]
    for stream in streams:
        beginning(stream, b"event: connections")
    on_its_way = sent(server, head, body[:40], len(body))
    endless = sent(server, "POST /v1/agents HTTP/1.1\r\nContent-Type: application/json", b'{"name": ', 100)
    idle = sent(server)
    server.process.send_signal(signal.SIGTERM)
    for poll in polls:
        assert answer_on(poll)[0].startswith("http/1.1 204"), "nothing was waited for in vain: ask the next server"
    on_its_way.sendall(body[40:])
    for stream in streams:
        assert rest(stream).endswith(CHUNKS_END), "the stream ended, it was not cut off"
    status, answer = answer_on(on_its_way)
    assert status.startswith("http/1.1 200"), "a stroke on its way is played"
    status, problem = answer_on(endless)
    assert status.startswith("http/1.1 503")
    assert "retry-after: 1" in status
    assert json.loads(problem)["code"] == "draining"
    assert rest(idle) == b""
    assert server.process.wait(20) == 0
    assert "Traceback" not in server.log
    server.http.close()
    server.process.stdout.close()
    server.start()
    headers = {"Content-Type": "application/json", "Idempotency-Key": "last", "If-Match": "1"}
    again = mover.request("POST", f"/v1/games/{view['game']}/shots", content=body, headers=headers)
    assert again.status_code == 200
    assert again.content == answer, "what was answered while stopping is stored"


def test_a_stream_that_begins_while_the_server_stops_ends_too(own_server, table_at, sent):
    server = own_server()
    game = table_at(server).game
    stream = sent(server, f"GET /v1/games/{game}/stream HTTP/1.1")
    server.process.send_signal(signal.SIGTERM)
    said = rest(stream)
    assert said == b"" or b" 503 " in said or (b" 200 " in said and said.endswith(CHUNKS_END))
    assert server.process.wait(20) == 0
