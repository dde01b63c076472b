"""What a batch of strokes comes to, as arrays: the same answers as ``EightBall.apply``, thousands at a time.

A search wants to know of each of many thousand strokes who shoots next and whether the game is over; rulings, words and
evidence it does not need. Strokes may start from different tables, even of different games; breaks are not among them.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from physics.batch import Batch
from physics.constants import N_BALLS
from physics.facts import NEVER
from physics.status import Status
from physics.table import Table
from referee.game import EIGHT, Group, members
from referee.rules.fouls import MISCUES
from referee.rules.stroke_facts import CUE_BALL

OPEN: Final = -1
"""Number of a shooter's group while the table is open; solids are 0, stripes 1."""
SAFETY_CALL: Final = -1
"""Number of the called ball when a safety is called."""

_GROUPS: Final = (Group.SOLIDS, Group.STRIPES)
Flags = NDArray[np.bool_]


def group_number(group: Group | None) -> int:
    """-1 on an open table, 0 solids, 1 stripes."""
    return OPEN if group is None else _GROUPS.index(group)


@dataclass(frozen=True, slots=True, eq=False)
class Verdicts:
    """What n strokes came to; each array is (n,).

    Attributes:
        won, lost: the stroke decided the game, for or against the shooter.
        continues: the shooter goes on: the called ball legally in the called pocket, nothing decided.
        fouled: a foul; unless the game is over, the opponent has the cue ball in hand.
        played: the stroke was one (a miscue is); False where the status says that it could not be played at all.
        group: int8, the shooter's group afterwards: -1 open, 0 solids, 1 stripes.
    """

    won: Flags
    lost: Flags
    continues: Flags
    fouled: Flags
    played: Flags
    group: NDArray[np.int8]

    def __len__(self) -> int:
        return len(self.won)


def read_verdicts(
    table: Table,
    before: NDArray[np.float64],
    group: NDArray[np.int8],
    ball: NDArray[np.int64],
    pocket: NDArray[np.int64],
    batch: Batch,
    kitchen: bool | Flags = False,
) -> Verdicts:
    """Rule on strokes other than the break (R18 to R47), all counters (R49) aside.

    Args:
        before: (n, 16, 2) m, the tables before, the cue ball placed.
        group: (n,) the shooter's group before: -1 open, 0 solids, 1 stripes.
        ball, pocket: (n,) the calls; ball -1 is a safety.
        batch: what the strokes did, row by row.
        kitchen: whether the cue ball was in hand behind the head string (R38); one answer for all, or (n,).
    """
    facts = batch.facts
    targets = target_balls(before, group)
    struck, down = facts["first_contact"] != NEVER, facts["pocketed"] != NEVER
    fouled = _fouls(facts, targets, struck, down)
    if np.any(kitchen):
        fouled |= kitchen & _from_kitchen(facts, struck, before[:, :, 1] <= table.head_string)
    made = _made(facts, ball, pocket, down)
    over = down[:, EIGHT] | (facts["off_table"][:, EIGHT] != NEVER)
    won = down[:, EIGHT] & targets[:, EIGHT] & (ball == EIGHT) & made & ~fouled
    continues = made & ~fouled & ~over
    of_ball = (ball > EIGHT).astype(np.int8)
    after = np.where(continues & (group == OPEN), of_ball, group).astype(np.int8)
    played = np.isin(batch.status, (Status.AT_REST, Status.EVENT_LIMIT, *MISCUES))
    return Verdicts(won, over & ~won, continues, fouled, played, after)


def target_balls(positions: NDArray[np.float64], group: NDArray[np.int8]) -> Flags:
    """(n, 16): the balls that may be called, and struck first (R20, R23, R27)."""
    member = np.zeros((2, N_BALLS), bool)
    for number, one in enumerate(_GROUPS):
        member[number, list(members(one))] = True
    allowed = np.vstack((member, member.any(axis=0)))  # the last row is that of an open table: index -1
    targets: Flags = allowed[group] & ~np.isnan(positions[:, :, 0])
    targets[:, EIGHT] = (group != OPEN) & ~targets.any(axis=1)
    return targets


def _fouls(facts: NDArray[np.void], targets: Flags, struck: Flags, down: Flags) -> Flags:
    """R32 to R36 and R39."""
    off = facts["off_table"] != NEVER
    any_struck, any_down = struck.any(axis=1), down.any(axis=1)
    driven = (facts["cushion_after_contact"] != NEVER).any(axis=1)
    fouled = down[:, CUE_BALL] | off.any(axis=1) | ~any_struck | ~(struck & targets).any(axis=1)
    fouled |= any_struck & ~any_down & ~driven
    fouled |= np.isin(facts["status"], MISCUES)
    found: Flags = fouled
    return found


def _from_kitchen(facts: NDArray[np.void], struck: Flags, beyond: Flags) -> Flags:
    """R38."""
    legal = (facts["crossed_before_contact"] != NEVER) | (struck & beyond).any(axis=1)
    crossed = facts["crossed_head_string"] != NEVER
    found: Flags = np.where(struck.any(axis=1), ~legal, ~crossed)
    return found


def _made(facts: NDArray[np.void], ball: NDArray[np.int64], pocket: NDArray[np.int64], down: Flags) -> Flags:
    """R24, fouls aside: the called ball fell in the called pocket."""
    rows = np.arange(len(ball))
    called = np.maximum(ball, 0)
    made: Flags = (ball != SAFETY_CALL) & down[rows, called] & (facts["pocket"][rows, called] == pocket)
    return made
