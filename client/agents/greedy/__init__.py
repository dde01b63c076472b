"""`greedy`: plays the stroke that is worth most right now, and never thinks about the one after it."""

from client.agents.greedy.agent import GreedyAgent

__all__ = ["GreedyAgent"]
