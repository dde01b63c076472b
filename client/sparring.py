"""Sparring: a match against a house bot of the server, made and played in one call."""

import httpx2

from client.agents.registry import Player
from client.errors import AgentNotFound
from client.http import Pooliad
from client.retry import Retry
from client.run import run_agent
from protocol import AgentView, ClockTerms, MatchOver, MatchRequest, NoiseTerms, Position
from referee import Game


def spar(
    agent: Player,
    url: str,
    token: str,
    bot: str,
    *,
    games: int = 1,
    noise: float = 1.0,
    seconds: float = 300.0,
    start: Game | None = None,
    retry: Retry | None = None,
    transport: httpx2.BaseTransport | None = None,
) -> MatchOver:
    """Challenge a house bot, play the match, and return how it ended.

    A bot whose places are taken accepts when one is free.

    Args:
        agent, url, token, retry, transport: as for `client.run_agent`.
        bot: name of a house bot; `Pooliad.agents(house=True)` lists them.
        games, noise, seconds: of the match: how many, level, thinking time of each player in a game.
        start: where every game begins instead of a break, e.g. `view.to_game()`.

    Raises:
        AgentNotFound: the server has no house bot of this name, or there is no agent of the other.
        pydantic.ValidationError: terms that no match can have.
        client.PooliadError: as for `client.run_agent`; `Invalid` for a position that cannot be played on from.
    """
    with Pooliad(url, token, retry=retry, transport=transport) as server:
        request = MatchRequest(
            agents=(server.me().id, _house_bot(server, bot).id),
            games=games,
            noise=NoiseTerms(level=noise),
            clock=ClockTerms(seconds=seconds),
            start=None if start is None else Position.of(start),
        )
        match = server.create_match(request)
    return run_agent(agent, url, token, retry=retry, transport=transport, match=match.id)


def _house_bot(server: Pooliad, name: str) -> AgentView:
    """The house bot of this name; there are few enough for one page."""
    bots = server.agents(house=True).agents
    for bot in bots:
        if bot.name == name:
            return bot
    raise AgentNotFound(f"the server has no house bot {name!r}; it has {[bot.name for bot in bots]}")
