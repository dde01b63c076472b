"""What is let in, how slowly and how often: docs/protocol.md, limits."""

import asyncio
import contextlib
import json
import socket
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from support.server_time import StoppedTime

from server.errors import TooManyRequests
from server.http.connections import TIMED_OUT
from server.security import rates
from server.security.rates import Rates
from server.services.physics.pool import WAITING, PhysicsPool

SCENE: dict[str, Any] = {
    "balls": {"0": [0.5, 1.7]},
    "shots": [{"v": 1.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}],
}
TCP_ESTABLISHED = 1


# slow clients


def connected(server):
    host, _, port = server.url.removeprefix("http://").partition(":")
    return socket.create_connection((host, int(port)), timeout=20)


def until_closed(connection):
    """Everything the server says until it closes the connection."""
    said = b""
    with contextlib.suppress(ConnectionResetError):  # what was still being sent came too late
        while part := connection.recv(4096):
            said += part
    return said


def trickle(connection, parts, pause, stop):
    for part in parts:
        if stop.wait(pause):
            return
        try:
            connection.sendall(part)
        except OSError:
            return


def test_headers_that_trickle_in_forever_are_cut_off(own_server):
    server = own_server(POOLIAD_HEADER_SECONDS="0.7")
    stop = threading.Event()
    with connected(server) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\n")
        start = time.monotonic()
        parts = [f"x-{number}: y\r\n".encode() for number in range(1000)]
        sender = threading.Thread(target=trickle, args=(connection, parts, 0.1, stop))
        sender.start()
        said = until_closed(connection)
        stop.set()
        sender.join()
    assert said in (b"", TIMED_OUT)
    assert 0.6 < time.monotonic() - start < 10.0
    with connected(server) as silent:
        assert until_closed(silent) == TIMED_OUT


def test_a_second_request_whose_headers_never_end_is_cut_off_too(own_server):
    server = own_server(POOLIAD_HEADER_SECONDS="0.7")
    with connected(server) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nhost: x\r\n\r\n")
        assert connection.recv(4096).startswith(b"HTTP/1.1 200 ")
        connection.sendall(b"GET /healthz HTTP/1.1\r\n")
        assert until_closed(connection).endswith(TIMED_OUT)


def test_the_deadline_of_headers_leaves_long_polls_and_slow_bodies_alone(own_server):
    server = own_server(POOLIAD_HEADER_SECONDS="0.5")
    token = server.request("POST", "/v1/agents", json={"name": "ann"}).json()["token"]
    assert server.request("GET", "/v1/turns", token, params={"wait": 1.2}).status_code == 204

    def slowly():
        for part in (b'{"name"', b": ", b'"bob"}'):
            time.sleep(0.4)
            yield part

    headers = {"Content-Type": "application/json"}
    assert server.request("POST", "/v1/agents", content=slowly(), headers=headers).status_code == 201


def test_a_body_that_never_ends_is_cut_off(own_server):
    server = own_server(POOLIAD_BODY_SECONDS="0.5")
    with connected(server) as connection:
        connection.sendall(b"POST /v1/agents HTTP/1.1\r\nhost: x\r\ncontent-length: 100\r\n\r\n{")
        start = time.monotonic()
        said = until_closed(connection)
    assert said.startswith(b"HTTP/1.1 408 ")
    assert b"slow_body" in said
    assert 0.4 < time.monotonic() - start < 10.0


def simulations(token, shots):
    """A request whose answer is of some 400 bytes a shot."""
    body = json.dumps(SCENE | {"shots": SCENE["shots"] * shots}).encode()
    head = f"POST /v1/simulate/batch HTTP/1.1\r\nhost: x\r\nauthorization: Bearer {token}\r\n"
    return f"{head}content-type: application/json\r\ncontent-length: {len(body)}\r\n\r\n".encode() + body


def unread(server, name="ann", shots=10_000, batches=8):
    """A connection on which the server has more to say than anybody's buffers hold."""
    token = server.request("POST", "/v1/agents", json={"name": name}).json()["token"]
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.settimeout(30)
    connection.connect(("127.0.0.1", server.port))
    connection.sendall(simulations(token, shots) * batches)
    return connection


def test_an_answer_that_nobody_reads_is_given_up(own_server):
    with unread(own_server(POOLIAD_UNREAD_SECONDS="0.5")) as connection:
        start = time.monotonic()
        while time.monotonic() < start + 20 and not closed(connection):
            time.sleep(0.1)
        assert closed(connection)


def test_answers_that_wait_to_be_read_are_bounded_together(own_server):
    """Whoever comes beyond the bound is closed, whoever waits within it is not."""
    server = own_server(POOLIAD_HELD_ANSWERS="20000000")
    with unread(server, "ann", batches=1) as first, unread(server, "bob", batches=8) as second:
        start = time.monotonic()
        while time.monotonic() < start + 20 and not closed(second):
            time.sleep(0.1)
        assert closed(second)
        assert not closed(first)


def test_an_answer_that_is_read_slowly_is_not(own_server):
    """More than 64 kB in two seconds, for longer than that."""
    with unread(own_server(POOLIAD_UNREAD_SECONDS="2")) as connection:
        for _ in range(25):
            time.sleep(0.1)
            assert sum(len(connection.recv(4096)) for _ in range(16)) > 16 * 1024


def closed(connection):
    """Whether the other side has given the connection up, whatever there still is to read."""
    return connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO) != TCP_ESTABLISHED


# large bodies


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/v1/agents", 413),
        ("/v1/matches", 413),
        ("/v1/nothing", 413),
        ("/v1/simulate", 413),
        ("/v1/simulate/batch", 401),
        ("/v1/tournaments", 401),
    ],
)
def test_a_large_body_is_taken_where_one_is_of_use(server, path, status):
    assert server.request("POST", path, json={"name": "x" * 70_000}).status_code == status


def begun(server, size, length):
    """A request without a token of whose body so much has come."""
    connection = connected(server)
    head = f"POST /v1/simulate/batch HTTP/1.1\r\nhost: x\r\ncontent-length: {length}\r\n\r\n"
    connection.sendall(head.encode() + b" " * size)
    return connection


def test_the_bodies_of_all_requests_together_are_bounded(own_server, table_at, break_shot):
    """Two thousand connections without a token could make the server keep four gigabytes; a stroke always fits."""
    server = own_server(POOLIAD_HELD_BODIES="100000", POOLIAD_BODY_SECONDS="20")
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    with begun(server, 90_000, 200_000) as first:
        time.sleep(0.5)
        refused = server.request("POST", "/v1/simulate/batch", content=b" " * 90_000)
        problem = refused.json()
        assert (refused.status_code, problem["code"], refused.headers["retry-after"]) == (429, "too_many_requests", "1")
        assert problem["allowed"] == "100000 bytes at once"
        assert mover.act(view, break_shot).status_code == 200
        first.sendall(b" " * 110_000)
        assert first.recv(4096).startswith(b"HTTP/1.1 429 "), "200,000 are too many alone"
    assert server.request("POST", "/v1/simulate/batch", content=b" " * 90_000).status_code == 401


# frequent clients


def test_a_bucket_lets_a_burst_through_and_then_a_steady_rate():
    now = StoppedTime()
    buckets = Rates(rate=2.0, burst=4.0, time=now)
    for _ in range(4):
        buckets.take("ann")
    with pytest.raises(TooManyRequests) as refused:
        buckets.take("ann")
    assert (refused.value.key, refused.value.seconds) == ("ann", 1)
    buckets.take("bob")
    now.pass_(0.5)
    buckets.take("ann")
    with pytest.raises(TooManyRequests):
        buckets.take("ann")


def test_what_costs_more_than_a_bucket_holds_passes_and_is_paid_for():
    now = StoppedTime()
    buckets = Rates(rate=1.0, burst=10.0, time=now)
    buckets.take("ann", cost=30.0)
    with pytest.raises(TooManyRequests) as refused:
        buckets.take("ann")
    assert refused.value.seconds == 21
    now.pass_(21.0)
    buckets.take("ann")


def test_the_memory_of_callers_is_bounded(monkeypatch):
    monkeypatch.setattr(rates, "MOST_BUCKETS", 10)
    now = StoppedTime()
    buckets = Rates(rate=1.0, burst=5.0, time=now)
    for number in range(100):
        now.pass_(1.0)
        buckets.take(f"address {number}")
    assert len(buckets._buckets) <= 10


def test_too_many_requests_name_the_token_and_the_seconds(own_server):
    server = own_server(POOLIAD_TOKEN_RATE="0.5", POOLIAD_TOKEN_BURST="3")
    made = server.request("POST", "/v1/agents", json={"name": "ann"}).json()
    statuses = [server.request("GET", "/v1/turns", made["token"]).status_code for _ in range(4)]
    assert statuses == [204, 204, 204, 429]
    refused = server.request("GET", "/v1/turns", made["token"])
    problem = refused.json()
    assert problem["code"] == "too_many_requests"
    assert made["agent"]["id"] in problem["detail"]
    assert refused.headers["retry-after"] == str(problem["value"])
    assert problem["value"] in (1, 2), "half a request a second"
    other = server.request("POST", "/v1/agents", json={"name": "bob"}).json()
    assert server.request("GET", "/v1/turns", other["token"]).status_code == 204


def test_guesses_of_tokens_are_counted_by_address(own_server):
    server = own_server(POOLIAD_ADDRESS_RATE="0.01", POOLIAD_ADDRESS_BURST="3")
    guesses = [server.request("GET", "/v1/turns", f"pool_agt_guess{number}").status_code for number in range(5)]
    assert guesses == [401, 401, 401, 429, 429]
    assert "address 127.0.0.1" in server.request("GET", "/v1/agents").json()["detail"]
    assert server.request("GET", "/healthz").status_code == 200


def test_the_movers_own_shots_are_never_too_many(own_server, table_at, break_shot):
    """After any number of refusals in a turn the clock decides, not a 429; whose turn it is not is counted."""
    server = own_server(POOLIAD_TOKEN_RATE="0.01", POOLIAD_TOKEN_BURST="12")
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    refused = [mover.act(view, break_shot | {"call": "safety"}).status_code for _ in range(25)]
    assert refused == [422] * 25
    other = next(player for player in table.players if player.id != mover.id)
    statuses = {other.act(view, break_shot).status_code for _ in range(14)}
    assert statuses == {409, 429}
    assert mover.act(view, break_shot).status_code == 200


def test_a_batch_counts_by_its_shots(own_server):
    server = own_server(POOLIAD_TOKEN_RATE="0.01", POOLIAD_TOKEN_BURST="10")
    token = server.request("POST", "/v1/agents", json={"name": "ann"}).json()["token"]
    body = SCENE | {"shots": SCENE["shots"] * 1000}
    assert server.request("POST", "/v1/simulate/batch", token, json=body).status_code == 429
    small = SCENE | {"shots": SCENE["shots"] * 50}
    assert server.request("POST", "/v1/simulate/batch", token, json=small).status_code == 200


# the physics of clients


def test_no_more_simulations_wait_than_have_room():
    async def crowd():
        pool, gate = PhysicsPool(1), threading.Event()
        tasks = [asyncio.create_task(pool.run(gate.wait)) for _ in range(WAITING + 1)]
        await asyncio.sleep(0)
        with pytest.raises(TooManyRequests, match="physics of this server"):
            await pool.run(gate.wait)
        gate.set()
        await asyncio.gather(*tasks)
        assert pool.busy == 0
        pool.close()

    asyncio.run(crowd())


def test_a_game_goes_on_while_the_physics_is_taken(own_server, table_at):
    """All threads of the physics simulate, and more requests wait for them; a player's stroke does not."""
    server = own_server(POOLIAD_PHYSICS_THREADS="1")
    table = table_at(server)
    rows = SCENE | {"balls": {str(ball): [0.1 + 0.06 * ball, 0.5] for ball in range(16)}}
    big = rows | {"shots": [shot | {"v": 9.0, "phi": 0.02 * n} for n, shot in enumerate(rows["shots"] * 10_000)]}
    with ThreadPoolExecutor(4) as pool:
        answers = [pool.submit(table.players[0].request, "POST", "/v1/simulate/batch", json=big) for _ in range(4)]
        time.sleep(0.3)
        table.play(3)
        assert not all(answer.done() for answer in answers)
        assert {answer.result().status_code for answer in answers} == {200}
