"""A table in a TOML file: what is written is read back, by commands and event files too."""

import pytest

from client.arena.directory import EventError
from client.arena.terms import Terms
from client.cli.tables import load_table
from physics import InvalidTable, Table
from physics.table_file import read_table, write_table

TABLES = (
    Table.olympiad(),
    Table.olympiad().replace(mu_slide=0.1 + 0.2, cue_test=False),
    Table.nine_foot().replace(cushion="mathavan", e_cushion=0.9123456789012345),
)


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.digest[:6])
def test_a_written_table_is_the_same_table(tmp_path, table):
    write_table(tmp_path / "my_table.toml", table, ("a note",))
    assert read_table(tmp_path / "my_table.toml").digest == table.digest
    assert load_table(str(tmp_path / "my_table.toml")).digest == table.digest


def test_an_event_file_names_a_table_file_beside_it(tmp_path):
    table = TABLES[1]
    write_table(tmp_path / "my_table.toml", table)
    event = tmp_path / "event.toml"
    event.write_text('name = "e"\nentrants = ["greedy", "random"]\ntable = "my_table.toml"\n')
    assert Terms.read(event).spec.table == table.to_dict()
    event.write_text('name = "e"\nentrants = ["greedy", "random"]\ntable = "lost.toml"\n')
    with pytest.raises(EventError, match=r"lost\.toml"):
        Terms.read(event)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("name = ", "must be a TOML file"),
        ('name = "pond"', "name = 'pond': must be one of"),
        ('name = "olympiad"\nmu_slide = 7.0', "mu_slide = 7.0: must be a number in"),
    ],
)
def test_no_table_is_refused_by_field_and_value(tmp_path, text, words):
    (tmp_path / "t.toml").write_text(text)
    with pytest.raises(InvalidTable, match=words):
        read_table(tmp_path / "t.toml")
