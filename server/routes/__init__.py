"""The HTTP surface: thin endpoints that call services."""

from typing import Final

from fastapi import APIRouter

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
