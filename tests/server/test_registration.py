"""Registration has a rate of its own by address, and addresses are believed from named proxies (issue 13, item 5)."""

import pytest

from server.errors import SettingsError
from server.security.addresses import origin
from server.settings import Settings


def register(server, name, token=None, **headers):
    return server.request("POST", "/v1/agents", token, json={"name": name}, headers=headers)


def test_an_address_registers_so_many_agents_and_the_organiser_any_number(own_server, organiser_at):
    """Seen: 1,200 accounts in 15 s, each with rates of its own."""
    server = own_server(POOLIAD_REGISTRATION_RATE="0.001", POOLIAD_REGISTRATION_BURST="3")
    made = [register(server, f"agent {number} x") for number in range(5)]
    assert [response.status_code for response in made] == [201, 201, 201, 429, 429]
    problem = made[-1].json()
    assert problem["code"] == "too_many_requests"
    assert "registrations of address 127.0.0.1" in problem["detail"]
    assert made[-1].headers["retry-after"] == str(problem["value"])
    token = made[0].json()["token"]
    assert register(server, "by a player", token).status_code == 429
    assert server.request("GET", "/v1/agents").status_code == 200, "reads have their own rate"
    for number in range(4):
        assert organiser_at(server).post("/v1/agents", {"name": f"guest {number} x"}).status_code == 201


def test_nobody_gets_another_rate_by_saying_where_he_is_from(own_server):
    """Seen: every X-Forwarded-For from this machine was believed, and each made an address of its own."""
    server = own_server(POOLIAD_REGISTRATION_RATE="0.001", POOLIAD_REGISTRATION_BURST="2")
    statuses = [
        register(server, f"agent {number} x", **{"X-Forwarded-For": f"10.0.0.{number}"}).status_code
        for number in range(4)
    ]
    assert statuses == [201, 201, 429, 429]


def test_a_named_proxy_is_believed_about_the_last_address_it_added(own_server):
    """What stands before the proxy's own entry was written by the client."""
    server = own_server(
        POOLIAD_REGISTRATION_RATE="0.001", POOLIAD_REGISTRATION_BURST="1", POOLIAD_PROXIES="127.0.0.1, 10.9.0.0/16"
    )
    seen = [
        register(server, f"agent {number} x", **{"X-Forwarded-For": told}).status_code
        for number, told in enumerate(("203.0.113.1", "203.0.113.2", "203.0.113.1", "203.0.113.9, 203.0.113.1"))
    ]
    assert seen == [201, 201, 429, 429]
    assert register(server, "agent 7 x", **{"X-Forwarded-For": "203.0.113.2, 10.9.0.7"}).status_code == 429


@pytest.mark.parametrize("bad", ["*", "proxy.example", "10.0.0.0/33", "127.0.0.1;10.0.0.1", "10.0.0.1/8"])
def test_proxies_are_named_by_address(bad):
    with pytest.raises(SettingsError, match=r"proxies = .*: must be IP addresses and networks"):
        Settings(proxies=bad)


@pytest.mark.parametrize(
    ("host", "whose"),
    [
        ("203.0.113.7", "203.0.113.7"),
        ("::ffff:203.0.113.7", "203.0.113.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::/64"),
        ("2001:db8:1:2::1", "2001:db8:1:2::/64"),
        ("2001:db8:1:3::1", "2001:db8:1:3::/64"),
        ("::1", "::/64"),
        (None, "unknown"),
        ("x" * 100_000, "unknown"),
    ],
)
def test_an_address_is_a_host_or_its_network(host, whose):
    """RFC 6177: a site has a /64 to itself; counted by address it would have 2^64 rates."""
    assert origin(host) == whose
