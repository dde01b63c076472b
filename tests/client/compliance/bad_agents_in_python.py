"""Agents in Python that do one thing wrong, played by `pooliad agent run`."""

import client


class Raises(client.Agent):
    """Has a slip in it."""

    def choose(self, view):
        raise LookupError("no idea")


class Unmade(Raises):
    """Cannot be made."""

    def __init__(self):
        raise FileNotFoundError("model.bin")
