"""The journal: docs/running-tournaments.md, What is on the disk."""

import multiprocessing

import pytest

from client.arena.journal import DamagedJournal, Journal


def kinds(path):
    return [entry.kind for entry in Journal(path).new()]


def test_entries_come_back_in_order_and_once(tmp_path):
    journal = Journal(tmp_path / "j")
    for number in range(3):
        journal.append("game", number=number)
    assert [entry.fields for entry in journal.new()] == [{"number": number} for number in range(3)]
    assert list(journal.new()) == []
    Journal(tmp_path / "j").append("pause", reason="lunch")
    assert [entry.kind for entry in journal.new()] == ["pause"]


def test_a_journal_nobody_wrote_is_empty(tmp_path):
    assert kinds(tmp_path / "none") == []


@pytest.mark.parametrize("torn", [b"{", b'{"kind": "game", "at": "x"}', b"\x00" * 9000, b'{"kind": "ga' + b"x" * 5000])
def test_a_torn_last_line_is_no_line_and_is_cut_by_the_next(tmp_path, torn):
    path = tmp_path / "j"
    Journal(path).append("opened")
    with path.open("ab") as file:
        file.write(torn)
    assert kinds(path) == ["opened"]
    Journal(path).append("resumed")
    assert kinds(path) == ["opened", "resumed"]
    assert path.read_bytes().count(b"\n") == 2


def test_a_file_of_nothing_but_a_torn_line_begins_anew(tmp_path):
    (tmp_path / "j").write_bytes(b"{" * 10_000)
    Journal(tmp_path / "j").append("opened")
    assert kinds(tmp_path / "j") == ["opened"]


@pytest.mark.parametrize("line", [b"[]\n", b"nonsense\n", b'{"kind": "game"}\n', b"\xff\n"])
def test_a_complete_line_that_is_no_entry_is_named(tmp_path, line):
    path = tmp_path / "j"
    Journal(path).append("opened")
    with path.open("ab") as file:
        file.write(line)
    with pytest.raises(DamagedJournal, match="line 2"):
        kinds(path)


def _write(path, name):
    for number in range(100):
        Journal(path).append(name, number=number)


def test_several_processes_write_without_tearing_each_other(tmp_path):
    path = tmp_path / "j"
    context = multiprocessing.get_context("spawn")
    writers = [context.Process(target=_write, args=(path, name)) for name in ("a", "b")]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    entries = list(Journal(path).new())
    assert [entry.fields["number"] for entry in entries if entry.kind == "a"] == list(range(100))
    assert len(entries) == 200
