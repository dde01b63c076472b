"""Compiled plane geometry for thousands of tables at once: what Python calls of it, all together.

The chance of a pot is that the error of the cue's direction, normal with standard deviation `sigma`, stays between two
bounds: where the object ball meets the edge of the mouth, and where either ball touches another on its way. With a path
d of the cue ball, an error e moves its place at contact by d e, which turns the object ball by d e / (2 R cos(cut)).

Every array is C-contiguous float64 or int64; `positions` is (n, 16, 2) m with NaN for absent balls, `table` what
`client.agents.search.engine.table_row` makes. That module alone loads these: importing them needs the compiler, and
decides where their compiled code is kept.
"""

from client.agents.search.compiled.elevations import elevations
from client.agents.search.compiled.pots import list_pots
from client.agents.search.compiled.resting import new_memory
from client.agents.search.compiled.surveying import survey
from client.agents.search.compiled.worths import shooter, worths

__all__ = ["elevations", "list_pots", "new_memory", "shooter", "survey", "worths"]
