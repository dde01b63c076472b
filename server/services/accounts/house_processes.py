"""House bots as processes: started when the server listens, started again when they crash, stopped with it."""

import asyncio
import contextlib
import logging
import os
import secrets
import signal
import sys
from asyncio.subprocess import DEVNULL, PIPE, STDOUT, Process
from collections.abc import AsyncIterator
from functools import partial

from starlette.concurrency import run_in_threadpool

from server.errors import Unavailable
from server.services.accounts import house_bots
from server.services.accounts.house_bots import HouseBot
from server.services.matches.player_seeds import begin_or_wait
from server.services.runtime.context import Context
from server.services.runtime.periodic import Periodic, at_work

log = logging.getLogger("pooliad.server.house")

RENEW_EVERY = 2.0
"""Seconds between signs of life: two may be lost before the lease of 6 s is."""
LOOK_EVERY = 1.0
"""Seconds between looks for challenges that wait for a place."""
FIRST_PAUSE, LONGEST_PAUSE = 1.0, 30.0
"""Seconds before a bot that left is started again; doubled each time it leaves at once."""
STEADY = 60.0
"""Seconds a bot has to run for its next crash to be the first again."""
PATIENCE = 3.0
"""Seconds from SIGTERM to SIGKILL."""
LONGEST_LINE = 64 * 1024
"""Bytes of a bot's line that are logged."""


class House:
    """The bots that the settings name; raises `SettingsError` when they cannot be read."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._bots = house_bots.parse(context.settings.house_bots)
        self._holder = f"house_{secrets.token_hex(8)}"
        self._url: asyncio.Future[str] | None = None

    def listening(self, url: str) -> None:
        """Tell the bots where the server is; called on the loop, once it answers."""
        if self._url is not None and not self._url.done():
            self._url.set_result(url)

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """The bots at work for as long as the block lasts, from the moment the server listens."""
        if not self._bots:
            yield
            return
        self._url = asyncio.get_running_loop().create_future()
        ids = [await run_in_threadpool(house_bots.enter, self._context, bot) for bot in self._bots]
        keeping = (self._keep(bot, one) for bot, one in zip(self._bots, ids, strict=True))
        accepting = Periodic("taking up challenges that wait for a place", self._accept, LOOK_EVERY)
        try:
            async with at_work(*keeping, accepting.run()):
                yield
        finally:
            await run_in_threadpool(house_bots.release, self._context, self._holder)

    async def _keep(self, bot: HouseBot, agent_id: str) -> None:
        """Run the bot whenever no other server process does."""
        assert self._url is not None
        url = await asyncio.shield(self._url)
        while not self._context.kernels.straight.is_settled:  # else the bot would compile them beside the server
            await asyncio.sleep(LOOK_EVERY)
        while True:
            try:
                token = await run_in_threadpool(house_bots.take, self._context, agent_id, self._holder)
                if token is not None:
                    await self._run(bot, agent_id, {"POOLIAD_URL": url, "POOLIAD_TOKEN": token})
            except Unavailable:
                log.warning("house bot %s waits: the database does not answer", bot.name)
            except Exception:
                log.exception("house bot %s cannot be run; it is tried again", bot.name)
            await asyncio.sleep(RENEW_EVERY)

    async def _run(self, bot: HouseBot, agent_id: str, environment: dict[str, str]) -> None:
        """Start the bot, and again whenever it leaves, until another process has taken it."""
        loop, pause = asyncio.get_running_loop(), FIRST_PAUSE
        while True:
            started = loop.time()
            async with _process(bot, environment) as process:
                while process.returncode is None:
                    if not await self._is_still_ours(agent_id):
                        return
                    await _ended(process, RENEW_EVERY)
            log.error("house bot %s left with exit code %s; it is started again", bot.name, process.returncode)
            pause = FIRST_PAUSE if loop.time() - started > STEADY else min(LONGEST_PAUSE, 2.0 * pause)
            await asyncio.sleep(pause)

    async def _is_still_ours(self, agent_id: str) -> bool:
        """Whether no other process has taken the bot; nobody can while the database does not answer."""
        try:
            return await self._context.run_aside(partial(house_bots.renew, self._context, agent_id, self._holder))
        except Unavailable:
            return True

    async def _accept(self) -> None:
        await run_in_threadpool(accept_waiting, self._context)


def accept_waiting(context: Context) -> None:
    """Begin the matches that wait for a house bot with a free place, each in a transaction of its own."""
    for bot in house_bots.challenged(context):
        while _accept_next(context, bot):
            pass


def _accept_next(context: Context, bot: str) -> bool:
    with context.writing() as writing:
        match = house_bots.take_waiting(writing, bot)
        if match is None:
            return False
        begin_or_wait(writing, match)
        writing.woken.update((match.seat_0, match.seat_1))
        return True


@contextlib.asynccontextmanager
async def _process(bot: HouseBot, environment: dict[str, str]) -> AsyncIterator[Process]:
    """The bot's process, its words in the log; it ends with the block."""
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, "-P", "-m", "client.cli", "agent", "run", "--forever", "--", bot.agent),
        stdin=DEVNULL,
        stdout=PIPE,
        stderr=STDOUT,
        env=_without_secrets() | environment,
        limit=LONGEST_LINE,
        start_new_session=True,
    )
    telling = asyncio.create_task(_tell(bot, process))
    try:
        yield process
    finally:
        await _stop(process)
        telling.cancel()


def _without_secrets() -> dict[str, str]:
    """The environment less the server's own settings: a bot has no business with the organiser's token."""
    return {name: value for name, value in os.environ.items() if not name.startswith("POOLIAD_") or name in _SHARED}


_SHARED = ("POOLIAD_CACHE_DIR",)
"""Where compiled kernels are kept is no secret, and a bot would compile them anew."""


async def _tell(bot: HouseBot, process: Process) -> None:
    """Log what the bot writes, line by line."""
    assert process.stdout is not None
    while True:
        try:
            line = await process.stdout.readline()
        except ValueError:  # longer than the limit: asyncio has thrown it away
            line = b"(a line too long to be logged)"
        if not line:
            return
        log.warning("house bot %s: %s", bot.name, line.decode(errors="replace").rstrip())


async def _ended(process: Process, seconds: float) -> None:
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(process.wait(), seconds)


async def _stop(process: Process) -> None:
    """End the bot and whatever it has started: its session's process group."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGTERM)
        await _ended(process, PATIENCE)
        os.killpg(process.pid, signal.SIGKILL)
    await process.wait()
