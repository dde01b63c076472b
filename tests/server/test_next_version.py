"""An upgrade within the same engine leaves running matches alone; another engine calls them off (docs/upgrading.md).

The next version is this one's sources with an edit, and its own version number, before the installed ones on the path.
"""

import json
import os

import pytest
from support.require import ROOT

from referee.record import RecordVerdict, this_engine, verify_record


@pytest.fixture
def next_version(tmp_path):
    """What the environment has to say for the package `referee` to be that of version 99.0, each file edited."""

    def make(edit):
        for path in (ROOT / "referee").rglob("*.py"):
            copy = tmp_path / "next" / path.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text(edit(path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")), encoding="utf-8")
        metadata = tmp_path / "next" / "pooliad-99.0.dist-info" / "METADATA"
        metadata.parent.mkdir()
        metadata.write_text("Metadata-Version: 2.1\nName: pooliad\nVersion: 99.0\n", encoding="utf-8")
        return {"PYTHONPATH": os.pathsep.join([str(tmp_path / "next"), str(ROOT)]), "PYTHONSAFEPATH": "1"}

    return make


def comments(_name, text):
    """Another comment in every file, and another docstring."""
    assert text.startswith('"""') or not text
    return f'"""Said otherwise.{text.removeprefix(chr(34) * 3)}\n# why\n' if text else text


def rule(name, text):
    """Another limit of the rules."""
    return text + "\nREVISED = 2\n" if name == "referee/rules/stalemate.py" else text


def upgraded(server, environment):
    server.stop()
    server.environment |= environment
    server.start()


@pytest.mark.slow
def test_a_match_goes_on_when_the_next_version_has_the_same_engine(own_server, table_at, next_version):
    """Its second game begins after the upgrade: both records lead to the one commitment, with the engine it names."""
    server = own_server()
    table = table_at(server, games=2, clock={"seconds": 3600})
    table.play(1)
    upgraded(server, next_version(comments))
    assert table.is_running
    for _ in range(2):
        mover, view = table.mover()
        assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    match = server.request("GET", f"/v1/matches/{table.match['id']}").json()
    assert match["status"] == "finished"
    for game in match["played"]:
        record = server.request("GET", f"/v1/games/{game['id']}/record").text.splitlines()
        found = verify_record(record)
        assert found.verdict is RecordVerdict.VERIFIED, str(found)
        header = json.loads(record[0])
        assert (header["engine"], header["commitment"]) == (this_engine().to_dict(), match["commitment"])
    fresh = table_at(server)
    header = begun(server, fresh)
    assert header["engine"] == {"version": "99.0", "digest": this_engine().digest}


@pytest.mark.slow
def test_a_match_is_called_off_when_the_next_version_has_another_engine(own_server, table_at, next_version):
    server = own_server()
    table = table_at(server, clock={"seconds": 3600})
    table.play(1)
    game = table.game
    upgraded(server, next_version(rule))
    assert not table.is_running
    record = server.request("GET", f"/v1/games/{game}/record").text.splitlines()
    assert json.loads(record[-2])["outcome"]["reason"] == "aborted"
    assert verify_record(record).verdict is RecordVerdict.VERIFIED
    header = begun(server, table_at(server))
    assert header["engine"]["digest"] != this_engine().digest


def begun(server, table):
    """The header of a match's record, once its game is over."""
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    return json.loads(server.request("GET", f"/v1/games/{view['game']}/record").text.splitlines()[0])
