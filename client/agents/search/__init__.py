"""`search`: simulates what comes of its strokes under the game's noise, and values the tables they leave."""

from client.agents.search.agent import SearchAgent

__all__ = ["SearchAgent"]
