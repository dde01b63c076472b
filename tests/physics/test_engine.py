"""Loading the kernels: where compiled code is kept, and that the Python side agrees with the kernels' layout."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import physics
from physics import engine, facts, status
from physics.constants import POCKET_NAMES
from physics.events import KINDS, EventKind, Motion
from physics.kernels import layout
from physics.parameters import parameters

ROWS = (
    "X Y VZ VX VY WX WY WZ HX HY SINCE END NEXT "
    "VZ_CHANGE VX_CHANGE VY_CHANGE WX_CHANGE WY_CHANGE WZ_CHANGE Z HZ PRESSED"
)
SPEEDS = ("VX", "VY", "WX", "WY", "WZ")
POCKETS = ("POCKET_SW", "POCKET_W", "POCKET_NW", "POCKET_NE", "POCKET_E", "POCKET_SE")

ONE_SHOT = """
import physics
table = physics.Table.olympiad()
result = physics.simulate(table, physics.rack(table, "eight_ball", seed=1), physics.Shot(8.0, 270.0, 10.0))
print(result.final.positions.tobytes().hex())
"""


def run_shot(**environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", ONE_SHOT],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"} | environment,
        capture_output=True,
        text=True,
        check=True,
    )


def test_sizes_are_those_of_the_layout():
    assert engine.workspace().shape == (1, layout.W_SIZE + layout.K_SIZE)
    assert parameters(physics.Table.olympiad()).shape == (1, layout.P_SIZE)
    assert facts.FACTS_DTYPE.itemsize == 4 * layout.FACTS_WIDTH
    padding = layout.F_INTEGERS % 2  # the float64 begin at a multiple of 8 bytes
    assert layout.F_INTEGERS + padding + 2 * (layout.F_CUE_Y + 1 - layout.F_DURATION) == layout.FACTS_WIDTH
    assert parameters(physics.Table.nine_foot()).shape == (1, layout.P_REAL_SIZE)


def test_no_two_quantities_share_a_place():
    """Rows of 16 lanes and lists of 120 pairs follow one another; a state's columns and a trace row's too."""
    rows = ROWS.split()
    lists = ("CLOSING", "NORMAL_X", "NORMAL_Y", "NORMAL_Z")
    used = [getattr(layout, name) + lane for name in rows for lane in range(layout.LANES)]
    used += [getattr(layout, name) + pair for name in lists for pair in range(layout.MOST_PAIRS)]
    assert sorted(used) == list(range(layout.W_SIZE))
    assert all(getattr(layout, f"{name}_CHANGE") - getattr(layout, name) == layout.CHANGE for name in ("VZ", *SPEEDS))
    assert [getattr(layout, name) for name in SPEEDS] == list(layout.SPEEDS)
    assert layout.TRACE_WIDTH == layout.T_FIRST + 2 * layout.STATE_WIDTH
    assert layout.REAL_TRACE_WIDTH == layout.T_FIRST + 2 * layout.REAL_STATE_WIDTH


def test_facts_lie_where_kernels_write_them():
    offsets = {name: offset // 4 for name, (_, offset, *_) in facts.FACTS_DTYPE.fields.items()}
    places = {
        "status": layout.F_STATUS,
        "n_events": layout.F_EVENTS,
        "crossed_head_string": layout.F_CROSSED,
        "crossed_before_contact": layout.F_CROSSED_BEFORE,
        "first_contact": layout.F_FIRST,
        "cushion": layout.F_CUSHION,
        "cushion_after_contact": layout.F_CUSHION_AFTER,
        "pocketed": layout.F_POCKETED,
        "pocket": layout.F_POCKET,
        "off_table": layout.F_OFF_TABLE,
        "frozen_to_cushion": layout.F_FROZEN_CUSHION,
        "frozen_to_cue_ball": layout.F_FROZEN_CUE,
        "miscue": layout.F_MISCUE,
        "duration": 2 * layout.F_DURATION,
        "first_contact_cue_ball": 2 * layout.F_CUE_X,
    }
    assert offsets == places


def test_numbers_of_states_kinds_and_statuses_are_those_of_the_layout():
    for motion in Motion:
        assert getattr(layout, motion.name) == motion
    for number, kind in enumerate(KINDS):
        assert getattr(layout, kind.name) == number
    assert set(KINDS) == set(EventKind)
    for each in status.Status:
        assert getattr(layout, each.name) == each


def test_recorded_numbers_stay():
    """Records and answers of version 0.1.0 hold these: a new one is appended."""
    assert [motion.name for motion in Motion] == (
        ["STATIONARY", "SPINNING", "SLIDING", "ROLLING", "POCKETED", "ABSENT", "FLYING", "DRIVEN_OFF"]
    )
    assert [each.name for each in status.Status] == (
        ["AT_REST", "CUE_OBSTRUCTED", "TIP_OFF_BALL", "OUT_OF_RANGE", "NO_CUE_BALL", "EVENT_LIMIT"]
    )
    assert (layout.WEST, layout.EAST, layout.SOUTH, layout.NORTH) == (0, 1, 2, 3)
    names = [name.removeprefix("POCKET_") for name in sorted(POCKETS, key=lambda name: getattr(layout, name))]
    assert tuple(names) == POCKET_NAMES


def test_a_workspace_is_no_other_threads():
    """Kernels address memory by pointer: two threads' workspaces must not share any (found as heap corruption)."""
    with ThreadPoolExecutor(1) as other:
        first, second = engine.workspace(), other.submit(engine.workspace).result()
    assert engine.workspace() is first
    assert not np.shares_memory(first, second)


def test_the_cache_folder_is_named_by_the_kernels(monkeypatch, tmp_path):
    monkeypatch.setenv(engine.CACHE_VARIABLE, str(tmp_path))
    folder = engine.cache_folder()
    assert folder == tmp_path / "pooliad" / f"kernels-{engine.digest()[:16]}"
    assert folder.is_dir()


def test_an_edited_kernel_has_another_digest(tmp_path):
    """A stale compiled cache is impossible: the folder's name holds every byte of the kernels."""
    sources = tmp_path / "kernels"
    sources.mkdir()
    (sources / "loop.py").write_text("x = 1\n")
    before = engine.digest_of(sources)
    (sources / "loop.py").write_text("x = 2\n")
    assert engine.digest_of(sources) != before


def test_no_home_and_nothing_writable_is_no_error(tmp_path):
    unwritable = tmp_path / "file"
    unwritable.write_text("not a folder")
    usual = run_shot()
    lost = run_shot(HOME=str(unwritable), XDG_CACHE_HOME=str(unwritable), POOLIAD_CACHE_DIR=str(unwritable))
    assert lost.stdout == usual.stdout


def test_compiling_is_announced_for_what_is_not_kept_yet(tmp_path, capsys):
    """Kernels of straight mouths that are kept say nothing about those with jaws."""
    (tmp_path / "kernels_0").mkdir()
    (tmp_path / "kernels_0" / "entries.simulate_rows-24.py311.nbi").touch()
    engine.say_if_compiled_now(tmp_path, "entries", "the physics")
    assert capsys.readouterr().err == ""
    engine.say_if_compiled_now(tmp_path, "entries_real", "the physics of tables with jaws")
    assert "compiling the physics of tables with jaws" in capsys.readouterr().err
    engine.say_if_compiled_now(None, "entries", "the physics")
    assert "compiling the physics for" in capsys.readouterr().err


CALLED_APART = """
import sys
import llvmlite.binding as llvm
from physics.engine import kernels
from physics.kernels.apart import _APART
def bound():
    return {name for name in _APART if llvm.address_of_symbol(name)}
kernels()
assert bound() == {name for name in _APART if name.endswith(" Workspace")}, "its own, and none of the other tables"
kernels(jaws=True)
print(len(_APART), len(bound()))
"""


def test_kernels_apart_are_bound_by_name_for_the_tables_that_ask():
    done = subprocess.run(
        [sys.executable, "-c", CALLED_APART],
        env=os.environ | {"NUMBA_DISABLE_JIT": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    known, bound = map(int, done.stdout.split())
    assert known == bound > 10
