"""What `server.http.connections` and `server.serve` use of uvicorn and h11 beyond their documents (docs/security.md).

A release that renames one of these would take a limit away without an error: these fail first.
"""

import inspect
from types import SimpleNamespace
from typing import Any

import h11
import pytest
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.server import ServerState

from server.http.connections import http_protocol
from server.serve import _HintingServer
from server.settings import Settings

BOUNDED = http_protocol(Settings())
OVERRIDDEN = [
    *((BOUNDED, H11Protocol, name) for name in ("connection_made", "data_received", "connection_lost")),
    *((BOUNDED, H11Protocol, name) for name in ("send_400_response", "pause_writing", "resume_writing")),
    *((_HintingServer, uvicorn.Server, name) for name in ("startup", "capture_signals")),
]


@pytest.mark.parametrize(("ours", "theirs", "name"), OVERRIDDEN, ids=lambda each: getattr(each, "__name__", each))
def test_what_is_overridden_is_there_and_takes_the_same(ours, theirs, name):
    assert getattr(ours, name) is not getattr(theirs, name)
    wanted, found = (inspect.signature(getattr(owner, name)).parameters for owner in (ours, theirs))
    assert list(wanted) == list(found)


async def no_app(scope, receive, send):
    raise AssertionError


def test_a_connection_has_what_the_limits_read():
    config = uvicorn.Config(no_app, h11_max_incomplete_event_size=1024, lifespan="off")
    config.load()
    loop: Any = SimpleNamespace()
    state = ServerState()
    protocol = BOUNDED(config, state, {}, _loop=loop)
    assert protocol.loop is loop
    assert protocol.server_state is state
    assert isinstance(state.default_headers, list)
    assert protocol.conn.their_state is h11.IDLE
    assert protocol.conn.trailing_data == (b"", False)
    protocol.conn.receive_data(b"GET / HT")
    assert protocol.conn.next_event() is h11.NEED_DATA
    assert protocol.conn.trailing_data[0] == b"GET / HT"


def test_a_head_that_is_too_large_is_named_by_its_status():
    connection = h11.Connection(h11.SERVER, max_incomplete_event_size=16)
    connection.receive_data(b"GET / HTTP/1.1\r\n" + b"a" * 32)
    with pytest.raises(h11.RemoteProtocolError) as refused:
        connection.next_event()
    assert refused.value.error_status_hint == 431
