"""Stored answers are deleted once nobody can ask for them again.

An answer is kept for at least `answer_seconds`, for as long as the match is on that it belongs to, and for the first
hour in which a server runs: a player who could not reach any asks then.
"""

from functools import partial
from typing import Final

from sqlalchemy import delete, exists, select, tuple_

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

_IN_A_MATCH: Final = exists().where(
    matches.c.status == RUNNING,
    games.c.match_id == matches.c.id,
    answers.c.route.like("/v1/games/" + games.c.id + "/%"),
)


def retention(context: Context) -> Periodic:
    """The look for old answers, now and then."""

    async def look() -> None:
        while await context.run_aside(partial(prune, context)) == BATCH:
            continue

    seconds = context.settings.answer_seconds
    return Periodic("deleting old answers", look, min(seconds, PERIOD), first=min(seconds, AFTER_START))


def prune(context: Context) -> int:
    """Delete the oldest answers that nobody can ask for again, at most a batch; how many they were."""
    keep = nanoseconds(context.settings.answer_seconds)
    with context.writing() as writing:
        old = (
            select(*answers.primary_key)
            .where(answers.c.created_at < writing.now - keep, ~_IN_A_MATCH)
            .order_by(answers.c.created_at)
            .limit(BATCH)
        )
        return writing.connection.execute(delete(answers).where(tuple_(*answers.primary_key).in_(old))).rowcount
