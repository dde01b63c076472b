"""Event-based pool physics: exact between events, fast, and the same bits everywhere.

Units and frame: metres, seconds, radians per second; a shot in Olympiad units (``Shot``). Origin at the south-west
corner of the cushion noses, x across the width, y along the length, the rack at the low-y end.

Importing this package compiles nothing and loads no compiler: kernels load at the first simulation.
"""

from physics.batch import Batch, simulate_batch
from physics.contact import contact_time, ring_contact_time
from physics.cue import Unplayable, check, min_elevation
from physics.cue_ball import squirt
from physics.errors import InvalidShot, InvalidState, InvalidTable, PhysicsError
from physics.events import BallState, Event, EventKind, Motion
from physics.facts import FACTS_DTYPE, Facts
from physics.generator import SeededStream
from physics.path_batch import Paths, simulate_paths
from physics.pockets import Jaw, Pocket
from physics.rack import rack
from physics.real_table import RealTable
from physics.result import Result
from physics.shot import Shot
from physics.simulation import resume, simulate
from physics.state import TableState
from physics.status import Status
from physics.table import Table
from physics.trajectory import Events, Snapshot

__all__ = [
    "FACTS_DTYPE",
    "BallState",
    "Batch",
    "Event",
    "EventKind",
    "Events",
    "Facts",
    "InvalidShot",
    "InvalidState",
    "InvalidTable",
    "Jaw",
    "Motion",
    "Paths",
    "PhysicsError",
    "Pocket",
    "RealTable",
    "Result",
    "SeededStream",
    "Shot",
    "Snapshot",
    "Status",
    "Table",
    "TableState",
    "Unplayable",
    "check",
    "contact_time",
    "min_elevation",
    "rack",
    "resume",
    "ring_contact_time",
    "simulate",
    "simulate_batch",
    "simulate_paths",
    "squirt",
]
