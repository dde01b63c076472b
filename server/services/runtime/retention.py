"""Stored answers are deleted once nobody can ask for them again.

An answer is kept for at least `answer_seconds`, for as long as the match is on that it belongs to, and for the first
hour in which a server runs: a player who could not reach any asks then.
"""

from functools import partial
from typing import Final

from sqlalchemy import delete, exists, func, select, tuple_

from referee.play import nanoseconds
from server.services.play.live_game import RUNNING
from server.services.runtime.context import Context
from server.services.runtime.periodic import Periodic
from server.store.tables import answers, games, matches

AFTER_START: Final = 3600.0
"""Seconds: longer than the SDK asks again for one answer."""
PERIOD: Final = 600.0
"""Seconds between two looks."""
BATCH: Final = 500
"""Answers deleted in one transaction: strokes do not wait long behind it."""

_OF_A_GAME: Final = "/v1/games/"
"""How the routes of a game's commands begin; its id follows."""
_ID: Final = len("game_") + 16
"""Letters of a game's id."""
_IN_A_MATCH: Final = exists().where(
    answers.c.route.startswith(_OF_A_GAME),
    games.c.id == func.substr(answers.c.route, len(_OF_A_GAME) + 1, _ID),
    matches.c.id == games.c.match_id,
    matches.c.status == RUNNING,
)


def retention(context: Context) -> Periodic:
    """The look for old answers, now and then."""

    async def look() -> None:
        while await context.run_aside(partial(prune, context)) == BATCH:
            continue

    seconds = context.settings.answer_seconds
    return Periodic("deleting old answers", look, min(seconds, PERIOD), first=min(seconds, AFTER_START))


def prune(context: Context) -> int:
    """Delete the oldest answers that nobody can ask for again, at most a batch; how many they were.

    They are looked for without the writer's place: what nobody can ask for now, nobody can ask for later.
    """
    before = context.time.now() - nanoseconds(context.settings.answer_seconds)
    old = select(*answers.primary_key).where(answers.c.created_at < before, ~_IN_A_MATCH)
    with context.database.reading() as connection:
        found = connection.execute(old.order_by(answers.c.created_at).limit(BATCH)).all()
    if not found:
        return 0
    with context.writing() as writing:
        these = tuple_(*answers.primary_key).in_([tuple(row) for row in found])
        # one that another process has deleted meanwhile may have been asked for, and answered, anew
        old_ones = delete(answers).where(these, answers.c.created_at < before)
        return writing.connection.execute(old_ones).rowcount
