"""A stroke under consideration."""

from dataclasses import dataclass

from physics import TableState
from referee import Action


@dataclass(frozen=True, slots=True)
class PlannedAction:
    """An action, and the table it would be played on: the cue ball placed."""

    action: Action
    before: TableState
