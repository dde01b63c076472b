"""`search`: simulates what comes of its strokes, and of the strokes after them, under the game's noise."""

from client.agents.search.agent import SearchAgent

__all__ = ["SearchAgent"]
