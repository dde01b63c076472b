"""docs/protocol.md, "Tables": every field of a table's description by its name."""

import re

from support.documents import PAGES

import protocol
from physics.table import NAMED

SECTION = re.search(r"\n## Tables\n(.*?)\n## ", PAGES["docs/protocol.md"].read_text(encoding="utf-8"), re.DOTALL)[1]
ROWS = {name for row in re.findall(r"^\| .+$", SECTION, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}
MODELS = (protocol.TableDescription, protocol.NoseView, protocol.PocketView, protocol.JawView)


def test_every_field_is_named_in_the_rows_and_nothing_else():
    assert ROWS - {"jaw_collision"} == {name for model in MODELS for name in model.model_fields}


def test_every_named_table_is_named():
    assert set(NAMED) <= set(re.findall(r"`(\w+)`", SECTION))
