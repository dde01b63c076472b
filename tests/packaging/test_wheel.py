"""What users get: the wheel, without the server and with it, run from a directory that is not the checkout."""

import json
import shutil
import zipfile

import pytest
from support.documents import PAGES, python_blocks
from support.require import ROOT

PACKAGES = ("physics", "pictures", "calibration", "referee", "tournament", "protocol", "server", "client")
BY_THE_RULES = {"R42", "R43", "R44", "R45", "R46"}


def test_the_wheel_holds_the_packages_and_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    assert {name.split("/")[0] for name in names if ".dist-info/" not in name} == set(PACKAGES)
    for package in PACKAGES:
        assert f"{package}/py.typed" in names
        sources = {str(path.relative_to(ROOT)) for path in (ROOT / package).rglob("*.py")}
        assert sources <= names
    assert any(name.endswith("licenses/LICENSE") for name in names)
    page = {str(path.relative_to(ROOT)) for path in (ROOT / "server" / "web").iterdir()}
    assert {"server/web/index.html", "server/web/main.js"} <= page <= names


@pytest.mark.slow
def test_the_base_install_has_everything_but_the_server(without_server):
    imports = without_server["imports"]
    assert imports.stdout.splitlines() == ["[]", "{True}"], imports.stderr


@pytest.mark.slow
@pytest.mark.parametrize("command", ["serve", "demo"])
def test_without_the_extra_a_command_names_what_installs_it(without_server, command):
    """At once: nothing is compiled for a demo that cannot be."""
    done = without_server[command]
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert "pip install 'pooliad[server]'" in line


@pytest.mark.slow
def test_the_base_install_plays_without_a_server(without_server):
    played = without_server["play"]
    assert played.returncode == 0, played.stderr
    assert played.stdout.strip()


@pytest.fixture(scope="module")
def demo(complete):
    """The account of a demo from the wheel: a real server, two agent processes, a whole match."""
    return json.loads(complete.must(["pooliad", "demo", "--seed", "4", "--out", "demo-4", "--json"]))


@pytest.mark.slow
def test_a_demo_from_the_wheel_ends_by_the_rules(demo):
    assert demo["status"] == "finished"
    (game,) = demo["games"]
    assert game["winner"] in demo["agents"]
    assert game["rule"] in BY_THE_RULES


@pytest.mark.slow
def test_the_record_verifies_with_nothing_but_the_file(demo, complete, tmp_path):
    """By a fresh process, the demo's database out of its sight; and not when a digit is changed."""
    (game,) = demo["games"]
    alone = tmp_path / "alone.jsonl"
    shutil.copy(game["record"], alone)
    verdict = json.loads(complete.must(["pooliad", "replay", "verify", alone, "--json"]))
    assert verdict["ok"] is True
    assert verdict["strokes"] == game["strokes"]
    assert verdict["outcome"]["rule"] == game["rule"]
    text = alone.read_text()
    at = text.index('"duration":') + len('"duration":')
    alone.write_text(text[:at] + str((int(text[at]) + 1) % 10) + text[at + 1 :])
    done = complete.run(["pooliad", "replay", "verify", alone, "--json"])
    assert done.returncode == 1
    assert json.loads(done.stdout)["verdict"] == "different"


@pytest.mark.slow
def test_an_agent_of_ones_own_is_found_where_one_stands(complete):
    """Seen: the documented `--agents straight:Straight` was not found by the installed command, and a folder called
    server beside it was taken for the server.
    """
    (block,) = [block.parsed for block in python_blocks(PAGES["README.md"]) if "client.Agent" in block.parsed]
    (complete.cwd / "straight.py").write_text(block)
    (complete.cwd / "server").mkdir()
    (complete.cwd / "server" / "__init__.py").write_text("raise SystemExit('not the server')")
    command = ["pooliad", "demo", "--agents", "straight:Straight", "random", "--seed", "2", "--out", "demo-2", "--json"]
    account = json.loads(complete.must(command))
    assert account["status"] == "finished"
    assert account["agents"] == ["Straight", "random"]
