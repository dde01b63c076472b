"""The proxy of `pooliad agent check` reads requests as a server does, whatever an HTTP library makes of them."""

import http.client
import json
import socket
import sys
import uuid
from contextlib import closing
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from client.compliance import SITUATIONS, Checker
from client.compliance.proxy import Proxy

BAD = Path(__file__).parent / "bad_agents.py"


@pytest.fixture
def proxy(hall):
    with Proxy(hall.url) as listening:
        yield listening


def test_a_body_in_chunks_arrives_whole(proxy):
    """Seen: it was passed on empty, and its chunks were taken for the next request. Node's http sends bodies so.

    RFC 9112, 7.1: a body in chunks has no length, and the connection goes on after its last one.
    """
    body = json.dumps({"name": f"chunks {uuid.uuid4().hex}"}).encode()
    with closing(http.client.HTTPConnection(urlsplit(proxy.url).netloc, timeout=60)) as agent:
        for part, status in ((10, 201), (len(body), 409)):
            pieces = (body[start : start + part] for start in range(0, len(body), part))
            agent.request("POST", "/v1/agents", pieces, {"Content-Type": "application/json"})
            answer = agent.getresponse()
            assert (answer.status, answer.read()[:1]) == (status, b"{")
    assert [one.body for one in proxy.seen()] == [body, body]


def test_an_agent_that_sends_its_actions_in_chunks_passes(hall, tmp_path):
    (situation,) = (one for one in SITUATIONS if one.name == "groups")
    (report,) = Checker(hall.url, hall.organiser_token, [sys.executable, str(BAD), "none", "chunks"], tmp_path).run(
        [situation]
    )
    assert report.faults == ()


@pytest.mark.parametrize(
    "framing",
    [
        "Content-Length: none",
        "Content-Length: -1",
        "Content-Length: +2",
        "Content-Length: 99999999999999",
        "Content-Length: 3",
        "Transfer-Encoding: gzip",
        "Transfer-Encoding: chunked\r\n\r\n-2\r\n{}\r\n0\r\n",
        "Transfer-Encoding: chunked\r\n\r\n2\r\n{}..0\r\n",
        "Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n",
        "Content-Length: 12\r\nTransfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n",
    ],
)
def test_a_body_of_no_length_is_answered_400(proxy, framing):
    """The connection ends then: where the next request begins cannot be known."""
    address = urlsplit(proxy.url)
    with socket.create_connection((address.hostname, address.port), timeout=60) as agent:
        agent.sendall(f"POST /v1/agents HTTP/1.1\r\nHost: here\r\n{framing}\r\n\r\n{{}}".encode())
        agent.shutdown(socket.SHUT_WR)
        answer = b"".join(iter(lambda: agent.recv(65536), b""))
    assert answer.startswith(b"HTTP/1.1 400 "), answer
    assert (answer.count(b"HTTP/1.1"), answer.count(b"Connection: close")) == (1, 1)
    (seen,) = proxy.seen()
    assert (seen.status, seen.code) == (400, "bad_header")
