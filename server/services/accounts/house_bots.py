"""House bots: agents that the server runs itself. Who they are, whom they play, and which process runs them.

Every server process may run the bots; a lease in the database says which one does. Whoever takes a lease gives the
bot a new token, so that a bot left over from another process is sent away.
"""

import re
import secrets
from dataclasses import dataclass
from typing import Any, Final

from pydantic import TypeAdapter, ValidationError
from sqlalchemy import Connection, Row, Select, delete, insert, or_, select, update

from protocol import MatchRequest
from protocol.agents import AgentName
from referee.play import nanoseconds
from server.errors import SettingsError, WrongStatus, invalid_field
from server.security.names import skeleton
from server.services.accounts.agents import insert_agent, namesake, renewed_token
from server.services.play.live_game import hold_match
from server.services.runtime.context import Context, Writing
from server.store.locks import only_one
from server.store.tables import agents, house, matches

MOST_GAMES: Final = 10
LONGEST_CLOCK: Final = 900.0
"""Bounds on what a challenge may ask of a house bot, so that nobody keeps its places for a day."""
LEASE: Final = 6.0
"""Seconds a process is believed to run a bot without a sign of life."""

_NAME: Final[TypeAdapter[str]] = TypeAdapter(AgentName)


@dataclass(frozen=True, slots=True)
class HouseBot:
    """A bot: what it is called on the server, and what `pooliad agent run` is told to play."""

    name: str
    agent: str


def parse(text: str) -> tuple[HouseBot, ...]:
    """The bots of `random;greedy;mine=stdio:perl mine.pl`; raises `SettingsError`."""
    bots = tuple(_bot(entry.strip()) for entry in re.split("[;\n]", text) if entry.strip())
    if len({skeleton(bot.name) for bot in bots}) != len(bots):
        raise SettingsError(f"house_bots = {text!r}: must be different names, none of which looks like another")
    return bots


def _bot(entry: str) -> HouseBot:
    name, equals, agent = (part.strip() for part in entry.partition("="))
    try:
        _NAME.validate_python(name)
    except ValidationError:
        name = ""
    if not name or (equals and not agent):
        raise SettingsError(f"house_bots = {entry!r}: must be NAME or NAME=AGENT, separated by semicolons")
    return HouseBot(name, agent or name)


def enter(context: Context, bot: HouseBot) -> str:
    """The bot's id, registered if need be; raises `SettingsError` when its name is somebody else's."""
    with context.writing() as writing:
        row = namesake(writing.connection, bot.name)
        if row is None:
            agent_id = f"agent_{secrets.token_hex(8)}"
            insert_agent(writing, agent_id, bot.name, house=True)
            return agent_id
        if not (row.house and row.name == bot.name):
            allowed = f"another name for it, such as house-{bot.name}={bot.agent}"
            whose = f"the name of an agent that registered, {row.name!r}, or one that looks like it"
            raise SettingsError(f"house_bots = {bot.name!r}, {whose}: must be {allowed}")
        return str(row.id)


def take(context: Context, agent_id: str, holder: str) -> str | None:
    """A new token for the bot if nobody runs it, and the lease with it; None when somebody does."""
    with context.writing() as writing:
        only_one(writing.connection, f"house bot {agent_id}")
        lease = writing.connection.execute(select(house).where(house.c.agent_id == agent_id)).one_or_none()
        if lease is not None and lease.until > writing.now and lease.holder != holder:
            return None
        writing.connection.execute(delete(house).where(house.c.agent_id == agent_id))
        entry = {"agent_id": agent_id, "holder": holder, "until": writing.now + nanoseconds(LEASE)}
        writing.connection.execute(insert(house).values(entry))
        return renewed_token(writing, agent_id)


def renew(context: Context, agent_id: str, holder: str) -> bool:
    """Go on running the bot; False when another process has taken it."""
    with context.writing() as writing:
        ours = (house.c.agent_id == agent_id) & (house.c.holder == holder)
        until = writing.now + nanoseconds(LEASE)
        return writing.connection.execute(update(house).where(ours).values(until=until)).rowcount == 1


def release(context: Context, holder: str) -> None:
    """Run no bot any more: another process may take them at once."""
    with context.writing() as writing:
        writing.connection.execute(delete(house).where(house.c.holder == holder))


def is_challenged(writing: Writing, request: MatchRequest, challenger: str | None) -> bool:
    """Whether an agent challenges a house bot; False for a match that an organiser makes."""
    if challenger is None:
        return False
    return any(_is_house(writing.connection, one) for one in request.agents if one != challenger)


def require_terms(writing: Writing, request: MatchRequest, challenger: str | None) -> None:
    """A challenge to a house bot is a short one."""
    if not is_challenged(writing, request, challenger):
        return
    if request.games > MOST_GAMES:
        raise invalid_field("games", request.games, f"at most {MOST_GAMES} against a house bot")
    if request.clock.seconds > LONGEST_CLOCK:
        raise invalid_field("clock.seconds", request.clock.seconds, f"at most {LONGEST_CLOCK:g} against a house bot")


def require_no_other(writing: Writing, request: MatchRequest, challenger: str | None) -> None:
    """Raise `WrongStatus` while another challenge of the same agent to the same house bot waits for a place."""
    if challenger is None or not is_challenged(writing, request, challenger):
        return
    bot = request.agents[1 - request.agents.index(challenger)]
    _hold_places(writing, bot)
    other = writing.connection.scalar(_challenges(bot).where(matches.c.challenger == challenger).limit(1))
    if other is not None:
        raise WrongStatus(f"the challenge {other} to the same house bot waits for a place: must be one; abort it")


def has_place(writing: Writing, match: Row[Any]) -> bool:
    """Whether the challenged agent is a house bot that takes the challenge now.

    It plays so many matches at a time, and one with the same opponent.
    """
    bot = match.seat_1 if match.challenger == match.seat_0 else match.seat_0
    if not _is_house(writing.connection, bot):
        return False
    _hold_places(writing, bot)
    opponents = _opponents(writing.connection, bot)
    return len(opponents) < writing.context.settings.house_places and match.challenger not in opponents


def challenged(context: Context) -> list[str]:
    """The house bots that have a place for a challenge that waits."""
    with context.database.reading() as connection:
        bots = connection.scalars(select(agents.c.id).where(agents.c.house)).all()
        return [bot for bot in bots if _oldest_waiting(context, connection, bot) is not None]


def take_waiting(writing: Writing, bot: str) -> Row[Any] | None:
    """The oldest challenge that the bot has a place for, to be begun by this transaction; None when there is none."""
    _hold_places(writing, bot)
    match_id = _oldest_waiting(writing.context, writing.connection, bot)
    if match_id is None:
        return None
    match = hold_match(writing.connection, match_id)
    return match if match.status == "challenged" else None


def _oldest_waiting(context: Context, connection: Connection, bot: str) -> str | None:
    opponents = _opponents(connection, bot)
    if len(opponents) >= context.settings.house_places:
        return None
    of_others = _challenges(bot).where(matches.c.challenger.not_in(opponents))
    return connection.scalar(of_others.order_by(matches.c.created_at, matches.c.id).limit(1))


def _challenges(bot: str) -> Select[str]:
    """The challenges to a bot that are not accepted yet."""
    to_it = _plays(bot) & (matches.c.challenger != bot)
    return select(matches.c.id).where(matches.c.status == "challenged", to_it)


def _opponents(connection: Connection, bot: str) -> list[str]:
    """Whom a bot plays now."""
    playing = select(matches.c.seat_0, matches.c.seat_1).where(matches.c.status.in_(("opening", "running")))
    rows = connection.execute(playing.where(_plays(bot)))
    return [row.seat_1 if row.seat_0 == bot else row.seat_0 for row in rows]


def _hold_places(writing: Writing, bot: str) -> None:
    """Nobody else gives places of this bot away until the transaction ends."""
    only_one(writing.connection, f"places of {bot}")


def _is_house(connection: Connection, agent_id: str) -> bool:
    return bool(connection.scalar(select(agents.c.house).where(agents.c.id == agent_id)))


def _plays(agent_id: str) -> Any:
    return or_(matches.c.seat_0 == agent_id, matches.c.seat_1 == agent_id)
