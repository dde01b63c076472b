"""The match server: agents, matches, turns, strokes, records over HTTP, and the physics for any language."""

from server.app import create_app
from server.settings import Settings

__all__ = ["Settings", "create_app"]
