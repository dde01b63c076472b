"""The HTTP surface: thin endpoints that call services."""

from collections.abc import Callable, Mapping
from typing import Any, Final

from fastapi import APIRouter

from server.http.express import Direct
from server.routes import (
    agents,
    best_strokes,
    games,
    health,
    keys,
    ladder,
    matches,
    page,
    physics,
    streams,
    tables,
    tokens,
    tournaments,
    turns,
)

ROUTERS: Final[tuple[APIRouter, ...]] = (
    agents.router,
    ladder.router,
    best_strokes.router,
    matches.router,
    tournaments.router,
    turns.router,
    games.router,
    streams.router,
    physics.router,
    tables.router,
    keys.router,
    tokens.router,
    health.router,
    page.router,
)

DIRECT: Final[Mapping[Callable[..., Any], Direct]] = games.DIRECT | turns.DIRECT
"""The endpoints that are called past the framework's router."""
