"""The player of an earlier commit as an opponent: a process in a checkout of its own, views in and actions out."""

import json
from pathlib import Path

from benchmarks.checkouts import Child
from benchmarks.recording import ROOT
from protocol import View
from referee import Action

CHILD = ROOT / "benchmarks" / "yardstick_child.py"


class Yardstick:
    """A process that plays as an agent of another checkout does.

    Args:
        tree: the checkout. name: of the agent. seed: of its choices.

    Raises:
        RuntimeError: it ended, or loaded another checkout's code.
    """

    def __init__(self, tree: Path, name: str, seed: int) -> None:
        self._child = Child(tree, (str(CHILD), name, str(seed)))

    def ask(self, game: str, view: View) -> tuple[Action, float, int]:
        """Its action, the processor time it took, s, and the shots it simulated."""
        said = self._child.ask(json.dumps({"game": game, "view": view.model_dump_json()}))
        return Action.from_dict(said["action"]), float(said["seconds"]), int(said["simulated"])

    def end(self) -> None:
        """Let the process end."""
        self._child.end()
