"""What `server.http` and `server.serve` use of uvicorn and httptools beyond their documents (docs/security.md).

A release that renames one of these would take a limit away without an error: these fail first.
"""

import inspect
from types import SimpleNamespace
from typing import Any

import httptools
import pytest
import uvicorn
from uvicorn.protocols.http.flow_control import FlowControl
from uvicorn.protocols.http.httptools_impl import STATUS_LINE, HttpToolsProtocol, RequestResponseCycle
from uvicorn.server import ServerState

from server.http.connections import http_protocol
from server.serve import _HintingServer
from server.settings import Settings

BOUNDED = http_protocol(Settings())
CONNECTION = ("connection_made", "data_received", "connection_lost", "pause_writing", "resume_writing")
PARSED = ("on_message_begin", "on_header", "on_headers_complete", "on_body", "on_message_complete")
OVERRIDDEN = [
    *((BOUNDED, HttpToolsProtocol, name) for name in (*CONNECTION, *PARSED, "on_response_complete")),
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
    config = uvicorn.Config(no_app, lifespan="off")
    config.load()
    loop: Any = SimpleNamespace()
    state = ServerState()
    protocol = BOUNDED(config, state, {}, _loop=loop)
    assert protocol.loop is loop
    assert protocol.server_state is state
    assert isinstance(state.default_headers, list)
    assert protocol.cycle is None
    assert isinstance(protocol.parser, httptools.HttpRequestParser)
    assert callable(protocol._unset_keepalive_if_required)
    assert {"pause_reading", "resume_reading"} <= set(dir(FlowControl))
    assert STATUS_LINE[431].startswith(b"HTTP/1.1 431 ")


def test_an_answer_has_what_the_limits_read():
    cycle: Any = RequestResponseCycle(**dict.fromkeys(inspect.signature(RequestResponseCycle).parameters, None))
    names = ("response_started", "response_complete", "disconnected", "chunked_encoding", "message_event")
    assert all(hasattr(cycle, name) for name in names)


class Heard:
    """What a parser tells, in its order."""

    def __init__(self) -> None:
        self.told: list[str] = []

    def __getattr__(self, name: str) -> Any:
        if name.startswith("on_"):
            return lambda *values: self.told.append(name)
        raise AttributeError(name)


def test_the_parser_tells_the_end_of_a_head_and_of_a_body_with_their_last_byte():
    heard = Heard()
    parser = httptools.HttpRequestParser(heard)
    parser.feed_data(b"POST / HTTP/1.1\r\nContent-Length: 1\r\n\r\n")
    assert heard.told[-1] == "on_headers_complete"
    parser.feed_data(b"x")
    assert heard.told[-2:] == ["on_body", "on_message_complete"]


def test_what_a_callback_raises_is_an_error_of_the_parser():
    def raising(*values: Any) -> None:
        raise ValueError

    parser = httptools.HttpRequestParser(SimpleNamespace(on_message_begin=raising))
    with pytest.raises(httptools.HttpParserError):
        parser.feed_data(b"GET / HTTP/1.1\r\n")
