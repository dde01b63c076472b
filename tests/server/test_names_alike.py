"""Names that look alike are one name (issue 13, item 5; Unicode UTS #39, section 4, confusables.txt 14.0.0)."""

import re
import string

import pytest
from alembic import command
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter
from sqlalchemy import select, text

from protocol.agents import AgentName
from server.errors import SettingsError
from server.security.names import CONFUSABLES, LONGEST_SKELETON, skeleton
from server.services.accounts import house_bots
from server.store.database import Database
from server.store.tables import agents
from server.store.upgrade import _config, upgrade

NAME = TypeAdapter(AgentName)
NAMES = st.from_regex(re.compile(r"[A-Za-z0-9][A-Za-z0-9 _.-]{0,63}", re.ASCII), fullmatch=True)
ALIKE = [
    *[("Ann", "ann"), ("ann", "ANN"), ("ann", "ann "), ("ann", "ann."), ("ann", "ann . ."), ("a n", "a  n")],
    *[("Ivan", "lvan"), ("agent-1", "agent-l"), ("agent-1", "agent-I"), ("bob", "b0b"), ("mary", "rnary")],
    *[("Illinois", "1111n0is"), ("ROM", "r0rn")],
]
APART = [("ann", "anne"), ("ann", "a.nn"), ("agent 1", "agent1"), ("a-b", "a_b"), ("bot 1", "bot 2"), ("bot2", "botz")]


@pytest.mark.parametrize(("one", "other"), ALIKE)
def test_names_that_look_alike_have_one_skeleton(one, other):
    assert skeleton(one) == skeleton(other)


@pytest.mark.parametrize(("one", "other"), APART)
def test_names_that_can_be_told_apart_have_two(one, other):
    assert skeleton(one) != skeleton(other)


@given(NAMES)
def test_a_skeleton_is_its_own_and_fits_its_column(name):
    common = skeleton(NAME.validate_python(name))
    assert skeleton(common) == common
    assert skeleton(name.swapcase()) == common
    assert skeleton(f"{name} .") == common
    assert 0 < len(common) <= LONGEST_SKELETON


def test_the_table_holds_every_line_about_characters_that_a_name_may_have():
    """A character beyond these would need more lines of Unicode's table."""
    allowed = {character for character in map(chr, range(0x250)) if _is_name(f"a{character}")}
    assert allowed == set(string.ascii_letters + string.digits + " _.-")
    assert {ord(source): target for source, target in CONFUSABLES.items()} == {
        0x30: "O".lower(),
        0x31: "l",
        ord("I".lower()): "l",
        0x6D: "rn",
    }


def _is_name(text):
    try:
        NAME.validate_python(text)
    except ValueError:
        return False
    return True


def test_a_name_that_looks_like_a_taken_one_is_refused_and_told_which(own_server, organiser_at):
    server = own_server()
    organiser = organiser_at(server)
    assert organiser.post("/v1/agents", {"name": "Illinois"}).status_code == 201
    for name in ("Illinois", "illinois", "lllinois", "1llin0is", "Illinois.", "Illinois "):
        response = organiser.post("/v1/agents", {"name": name})
        problem = response.json()
        assert (response.status_code, problem["code"], problem["field"]) == (409, "name_taken", "name"), name
        assert "'Illinois'" in problem["detail"]
    assert organiser.post("/v1/agents", {"name": "Illinoise"}).status_code == 201


def test_two_house_bots_that_look_alike_do_not_start():
    with pytest.raises(SettingsError, match="looks like another"):
        house_bots.parse("greedy;Greedy=random")


def test_a_database_whose_names_are_alike_already_opens_and_keeps_them(tmp_path, own_server, organiser_at):
    """As version 0.1.0 left it: revision 0001, two agents who look alike. A third one is refused."""
    url = f"sqlite:///{tmp_path / 'old.db'}"
    database = Database(url)
    with database.writing() as connection:
        config = _config()
        config.attributes["connection"] = connection
        command.upgrade(config, "0001")
        for number, name in enumerate(("ann", "Ann", "bob")):
            row = {"id": f"agent_{number}", "name": name, "house": False, "created_at": number}
            connection.execute(text("INSERT INTO agents VALUES (:id, :name, :house, :created_at)"), row)
    upgrade(database)
    with database.reading() as connection:
        rows = connection.execute(select(agents.c.name, agents.c.skeleton).order_by(agents.c.id)).all()
    database.dispose()
    assert [tuple(row) for row in rows] == [("ann", "ann"), ("Ann", "ann"), ("bob", "bob")]
    server = own_server(url)
    assert len(server.request("GET", "/v1/agents").json()["agents"]) == 3
    response = organiser_at(server).post("/v1/agents", {"name": "ANN"})
    assert response.status_code == 409
    assert organiser_at(server).post("/v1/agents", {"name": "anna"}).status_code == 201
