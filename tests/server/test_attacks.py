"""What strangers send to break a server (docs/security.md, "The door"): a clear error, and others are served."""

import gzip
import json
import socket
import time
from concurrent.futures import ThreadPoolExecutor

import pytest


@pytest.fixture
def at_break(new_table):
    """A game before its break; afterwards it must stand as it stood."""
    table = new_table(clock={"seconds": 600.0})
    mover, view = table.mover()
    yield mover, view
    assert mover.get(f"/v1/games/{view['game']}").json()["view"]["version"] == view["version"]


def shoot(mover, view, body, **headers):
    sent = {"Content-Type": "application/json", "If-Match": f'"{view["version"]}"', "Idempotency-Key": "raw"}
    return mover.request("POST", f"/v1/games/{view['game']}/shots", content=body, headers=sent | headers)


def require(response, status, code, field):
    problem = response.json()
    assert (response.status_code, problem["code"], problem["field"]) == (status, code, field), problem
    assert len(response.content) < 10_000
    return problem


def connected(server, source="127.0.0.1"):
    return socket.create_connection(("127.0.0.1", server.port), timeout=30, source_address=(source, 0))


def until_closed(connection):
    said = b""
    while part := connection.recv(65536):
        said += part
    return said


def exchanged(server, request):
    """A connection's whole answer to these bytes."""
    with connected(server) as connection:
        connection.sendall(request)
        return until_closed(connection)


def test_a_compressed_body_is_not_unpacked(at_break):
    """A bomb of a gigabyte has a megabyte packed; here it is refused for being packed at all (RFC 9110, 15.5.16)."""
    mover, view = at_break
    bomb = gzip.compress(b" " * 50_000_000)
    problem = require(
        shoot(mover, view, bomb, **{"Content-Encoding": "gzip"}), 415, "unsupported_media_type", "Content-Encoding"
    )
    assert problem["allowed"] == "identity"
    require(shoot(mover, view, bomb), 400, "not_json", "body")


@pytest.mark.parametrize(
    "body",
    [
        b'{"shot": {"v": 1, "v": 9, "phi": 270, "theta": 20, "a": 0, "b": 0}, "cue_ball": [0.5, 1.8]}',
        b'{"shot": {"v": 1, "phi": 270, "theta": 20, "a": 0, "b": 0}, "shot": null}',
        b'{"x": "a:b", "x": 1}',
        b'{"a": [{"b": 1, "b": 2}]}',
    ],
)
def test_a_key_that_comes_twice_is_named(at_break, body):
    """RFC 8259, 4: what receivers make of it is unpredictable; so nobody here has to predict it."""
    mover, view = at_break
    problem = require(shoot(mover, view, body), 400, "not_json", "body")
    assert "comes twice" in problem["detail"]


def test_a_colon_in_a_text_is_no_key(at_break):
    mover, view = at_break
    require(shoot(mover, view, b'{"shot": "a:b:c"}'), 422, "invalid", "shot")


@pytest.mark.parametrize(
    ("body", "status"),
    [
        (b"[" + b"1," * 500_000 + b"1]", 422),
        (b'{"shot": [' + b"1e9," * 250_000 + b"1]}", 422),
        (b'{"cue_ball": ' + b"9" * 1_000_000 + b"}", 400),
        (b"-" * 1_000_000, 400),
        (b'{"a":' * 150 + b"1" + b"}" * 150, 422),
        (b'{"' + b"a" * 1_000_000 + b'": 1}', 422),
    ],
    ids=["list", "field", "digits", "signs", "deep", "key"],
)
def test_a_megabyte_of_numbers_is_answered_in_a_few_words(new_player, body, status):
    """Where a megabyte is taken at all."""
    headers = {"Content-Type": "application/json"}
    response = new_player().request("POST", "/v1/simulate/batch", content=body, headers=headers)
    assert response.status_code == status, response.text
    assert len(response.content) < 10_000


def test_requests_sent_at_once_are_answered_in_their_order(server):
    """RFC 9112, 9.3.2: pipelining. None is answered with what belongs to another."""
    paths = ["/healthz", "/v1/nothing", "/v1/agents?limit=1", "/v1/games/none"] * 5
    requests = "".join(f"GET {path} HTTP/1.1\r\nHost: x\r\n\r\n" for path in paths[:-1])
    requests += f"GET {paths[-1]} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
    with connected(server) as connection:
        connection.sendall(requests.encode())
        said = until_closed(connection).split(b"HTTP/1.1 ")[1:]
    assert [int(answer[:3]) for answer in said] == [200, 404, 200, 404] * 5


def test_a_stroke_sent_twice_in_one_breath_is_played_once(new_table, break_shot):
    table = new_table(noise={"level": 0.0})
    mover, view = table.mover()
    body = json.dumps(break_shot).encode()
    head = (
        f"POST /v1/games/{view['game']}/shots HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer {mover.token}\r\n"
        f'Content-Type: application/json\r\nIdempotency-Key: once\r\nIf-Match: "{view["version"]}"\r\n'
        f"Content-Length: {len(body)}\r\n"
    )
    with connected(mover.server) as connection:
        connection.sendall((head + "\r\n").encode() + body + (head + "Connection: close\r\n\r\n").encode() + body)
        first, second = until_closed(connection).split(b"HTTP/1.1 200 OK")[1:]
    assert first.partition(b"\r\n\r\n")[2] == second.partition(b"\r\n\r\n")[2]
    assert len(mover.get(f"/v1/games/{view['game']}/shots").json()["shots"]) == 1


HIDDEN = b"GET /v1/agents HTTP/1.1\r\nHost: x\r\n\r\n"
"""A request inside what another length makes the body of the one before."""


AGENTS = b"POST /v1/agents HTTP/1.1\r\nHost: x\r\n"
HEALTH = b"GET /healthz HTTP/1.1\r\nHost: x\r\n"
CHUNKED = b"Transfer-Encoding: chunked\r\n"
NOTHING_MORE = b"0\r\n\r\n"
NO_REQUESTS = {
    "both lengths": AGENTS + b"Content-Length: 5\r\n" + CHUNKED + b"\r\n" + NOTHING_MORE + HIDDEN,
    "both lengths, no body": HEALTH + CHUNKED + b"Content-Length: 5\r\n\r\n" + NOTHING_MORE + HIDDEN,
    "two lengths": HEALTH + b"Content-Length: 5\r\nContent-Length: 6\r\n\r\nhello",
    "no chunk": AGENTS + CHUNKED + b"\r\nzz\r\n",
    "a chunk's size in two ways": AGENTS + CHUNKED + b"\r\n1 \r\nx\r\n" + NOTHING_MORE + HIDDEN,
    "chunks without CR": AGENTS + CHUNKED + b"\r\n1\nx\n0\n\n" + HIDDEN,
    "coded, then in chunks": AGENTS + b"Transfer-Encoding: gzip, chunked\r\n\r\n" + NOTHING_MORE + HIDDEN,
    "in chunks, then coded": AGENTS + b"Transfer-Encoding: chunked, gzip\r\n\r\n" + NOTHING_MORE + HIDDEN,
    "in chunks, nearly": AGENTS + b"Transfer-Encoding: xchunked\r\n\r\n" + NOTHING_MORE + HIDDEN,
    "a length before its colon": AGENTS + b"Content-Length : 5\r\n\r\nhello",
    "a folded field": HEALTH + b"X: a\r\n Content-Length: 5\r\n\r\n" + HIDDEN,
    "lines without CR": b"GET /healthz HTTP/1.1\nHost: x\n\n" + HIDDEN,
    "an end without CR": b"GET /healthz HTTP/1.1\r\nHost: x\r\n\n" + HIDDEN,
    "CR in a field": HEALTH + b"X: a\rContent-Length: 37\r\n\r\n" + HIDDEN,
    "NUL in a field": HEALTH + b"X: a\0b\r\n\r\n" + HIDDEN,
    "negative": AGENTS + b"Content-Length: -1\r\n\r\n",
    "no host": b"GET /healthz HTTP/1.1\r\n\r\n" + HIDDEN,
    "two hosts": HEALTH + b"Host: y\r\n\r\n" + HIDDEN,
    "HTTP/0.9": b"GET /healthz\r\n\r\n" + HIDDEN,
    "HTTP/2.0": b"GET /healthz HTTP/2.0\r\nHost: x\r\n\r\n" + HIDDEN,
    "a tunnel": b"CONNECT x:1 HTTP/1.1\r\nHost: x\r\n\r\n" + HIDDEN,
    "a tunnel to a path": b"CONNECT /healthz HTTP/1.1\r\nHost: x\r\n\r\n" + HIDDEN,
    "TLS": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
}


@pytest.mark.parametrize("sent", NO_REQUESTS.values(), ids=NO_REQUESTS)
def test_requests_that_are_none_are_refused(server, sent):
    """RFC 9112, 2.2, 3.2, 5.1 and 6.3: of what may be read in two ways, nobody knows where it ends."""
    said = exchanged(server, sent)
    assert said.startswith(b"HTTP/1.1 400 "), said
    assert said.count(b"HTTP/1.1 ") == 1
    assert server.request("GET", "/healthz").status_code == 200


@pytest.mark.parametrize("field", [b"Upgrade: h2c", b"upgrade: websocket", b"UPGRADE:pool"])
@pytest.mark.parametrize("pause", [False, True], ids=["in one breath", "the body later"])
def test_nothing_hides_behind_a_wish_for_another_protocol(server, field, pause):
    """The parser would skip the body, and take it for the next request; RFC 9110, 7.8 has the wish ignored."""
    fields = b"Content-Type: application/json\r\nConnection: Upgrade\r\n%b\r\n" % field
    head = AGENTS + fields + b"Content-Length: %d\r\n\r\n" % len(HIDDEN)
    with connected(server) as connection:
        connection.sendall(head)
        if pause:
            time.sleep(0.2)
        connection.sendall(HIDDEN + HEALTH + b"Connection: close\r\n\r\n")
        first, second = until_closed(connection).split(b"HTTP/1.1 ")[1:]
    assert first.startswith(b"400 ")
    assert b"not_json" in first
    assert second.startswith(b"200 ")


def test_fields_behind_a_body_are_no_fields_of_the_request(new_player):
    """RFC 9110, 6.5.1: what was checked before the body came is not changed after it."""
    player = new_player()
    token = b"Authorization: Bearer " + player.token.encode() + b"\r\n"
    body = b"2\r\n{}\r\n0\r\n"
    head = b"POST /v1/matches HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Type: application/json\r\n" + CHUNKED
    assert exchanged(player.server, head + b"\r\n" + body + token + b"\r\n").startswith(b"HTTP/1.1 401 ")
    said = exchanged(player.server, head + token + b"\r\n" + body + b"X: y\r\n\r\n")
    assert said.startswith((b"HTTP/1.1 400 ", b"HTTP/1.1 403 ", b"HTTP/1.1 422 "))


def test_fields_behind_a_body_without_end_are_cut_off(server):
    said = exchanged(server, AGENTS + CHUNKED + b"\r\n0\r\n" + b"X: y\r\n" * 3000)
    assert said.startswith(b"HTTP/1.1 400 "), said[:200]


def test_readers_of_1_0_get_no_chunks(server, new_table):
    """RFC 9112, 6.1: an answer of unknown length ends with its connection there."""
    table = new_table()
    mover, view = table.mover()
    mover.post(f"/v1/games/{table.game}/concede", version=view["version"])
    told = []
    for version in (b"1.0", b"1.1"):
        line = b"GET /v1/games/%b/stream HTTP/%b\r\nHost: localhost\r\nConnection: close\r\n\r\n"
        answer = exchanged(server, line % (table.game.encode(), version))
        head, _, body = answer.partition(b"\r\n\r\n")
        assert head.startswith(b"HTTP/1.1 200")
        assert (b"transfer-encoding: chunked" in head.lower()) == (version == b"1.1")
        told.append(body)
    assert told[0].startswith((b"id:", b"event:", b":", b"retry:"))
    assert b"event: result" in told[0]


def test_nonsense_behind_a_request_waits_for_its_answer(server):
    """Else the refusal would be taken for the answer of the request before it."""
    said = exchanged(server, HEALTH + b"\r\n" + HEALTH + b"Content-Length: x\r\n\r\n")
    first, second = said.split(b"HTTP/1.1 ")[1:]
    assert first.startswith(b"200 ")
    assert second.startswith(b"400 ")


def test_who_hangs_up_behind_requests_of_his_is_missed(own_server, table_at):
    """A stream ends with its reader, though a request waits behind it; else streams without readers would add up."""
    server = own_server(POOLIAD_STREAMS="1", POOLIAD_STREAM_KEEPALIVE="0.2")
    path = f"/v1/games/{table_at(server).game}/stream"
    with connected(server) as connection:
        connection.sendall(f"GET {path} HTTP/1.1\r\nHost: x\r\n\r\n".encode() + (HEALTH + b"\r\n") * 20_000)
        assert connection.recv(4096).startswith(b"HTTP/1.1 200 ")
        assert server.request("GET", path).status_code == 429
    end = time.monotonic() + 30
    while server.request("GET", "/v1/games/game_none/stream").status_code == 429:
        assert time.monotonic() < end
        time.sleep(0.05)


def test_chunks_without_end_are_cut_off(own_server):
    """As large as they like: 413; as slow as they like: 408."""
    server = own_server(POOLIAD_BODY_SECONDS="0.5", POOLIAD_BODY_LIMIT="10000")
    head = b"POST /v1/agents HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n"
    with connected(server) as slow, connected(server) as large:
        slow.sendall(head + b"1\r\n{\r\n")
        large.sendall(head + b"2ee0\r\n" + b" " * 12_000 + b"\r\n")
        assert until_closed(large).startswith(b"HTTP/1.1 413 ")
        assert until_closed(slow).startswith(b"HTTP/1.1 408 ")


def test_connections_of_one_address_are_bounded(own_server):
    """Those beyond the bound are told so, another address is served, and places come back."""
    server = own_server(POOLIAD_ADDRESS_CONNECTIONS="40", POOLIAD_HEADER_SECONDS="60")
    crowd = [connected(server, "127.0.0.2") for _ in range(40)]
    with connected(server, "127.0.0.2") as refused:
        said = until_closed(refused)
    assert said.startswith(b"HTTP/1.1 429 ")
    assert b"retry-after: 1" in said
    assert server.request("GET", "/healthz").status_code == 200, "from 127.0.0.1"
    for connection in crowd:
        connection.close()
    end = time.monotonic() + 30
    while not said.startswith(b"HTTP/1.1 200 "):
        assert time.monotonic() < end, said
        with connected(server, "127.0.0.2") as connection:
            connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
            said = until_closed(connection)


@pytest.mark.long
def test_ten_thousand_connections_from_one_address(own_server, table_at):
    """A match beside them is played; when their time is over all of them are gone."""
    server = own_server(POOLIAD_HEADER_SECONDS="5")
    table = table_at(server)
    with ThreadPoolExecutor(50) as pool:
        crowd = list(pool.map(lambda _: connected(server, "127.0.0.3"), range(10_000)))
    table.play(4)
    ends = [until_closed(connection)[:12] for connection in crowd]
    assert set(ends) <= {b"HTTP/1.1 429", b"HTTP/1.1 408"}
    assert ends.count(b"HTTP/1.1 408") <= 2000
    for connection in crowd:
        connection.close()
    table.play(2)


@pytest.mark.parametrize("pieces", [1, 40])
def test_the_head_of_a_request_is_bounded(server, pieces):
    """Request line and fields together, 16 KiB, in one packet or many (RFC 6585, 5)."""
    whole = b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n"
    fields = b"".join(b"X-%03d: %s\r\n" % (number, b"y" * 491) for number in range(40))  # 500 bytes each
    with connected(server) as connection:
        head = whole + fields + b"\r\n"
        size = -(-len(head) // pieces)
        for start in range(0, len(head), size):
            connection.sendall(head[start : start + size])
        said = until_closed(connection)
    assert said.startswith(b"HTTP/1.1 431 "), said[:200]
    assert exchanged(server, whole + fields[: 500 * 31] + b"\r\n").startswith(b"HTTP/1.1 200 "), "15.5 KiB"
    long_line = b"GET /healthz?%s HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
    assert exchanged(server, long_line % (b"a" * 17_000)).startswith(b"HTTP/1.1 431 ")
    assert exchanged(server, HEALTH + b"X: " + b"a" * 200_000 + b"\r\n\r\n").startswith(b"HTTP/1.1 431 ")


@pytest.mark.parametrize(
    "request_line",
    [
        *(b"GET /healthz", b"GET /", b"GET /web/style.css", b"GET /openapi.json", b"GET /metrics", b"GET /nothing"),
        *(b"GET /v1/turns", b"PUT /v1/agents", b"GET /v1/agents?limit=x", b"NOT HTTP AT ALL", b"GET /%00"),
    ],
)
def test_no_answer_may_be_sniffed(server, request_line):
    said = exchanged(server, request_line + b" HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
    head = said.partition(b"\r\n\r\n")[0].lower()
    assert head.startswith(b"http/1.1 ")
    assert head.count(b"x-content-type-options: nosniff") == 1, said[:400]


def test_the_servers_own_refusals_may_not_be_sniffed(own_server):
    server = own_server(POOLIAD_HEADER_SECONDS="0.3", POOLIAD_ADDRESS_CONNECTIONS="3")
    with connected(server) as slow:
        slow.sendall(b"GET / HTTP/1.1\r\n")
        assert b"x-content-type-options: nosniff" in until_closed(slow), "408"
    held = [connected(server) for _ in range(3)]
    said = exchanged(server, b"")
    for one in held:
        one.close()
    assert said.startswith(b"HTTP/1.1 429 ")
    assert b"x-content-type-options: nosniff" in said
