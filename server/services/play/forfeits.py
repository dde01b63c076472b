"""Ends that a supervisor decides: whoever runs the players saw one crash, stall, stay away or break the terms."""

from protocol import ForfeitRequest
from referee.game import EndReason
from server.errors import GameFinished
from server.http.commands import Answer, Command, once, parse
from server.services.play import games, history
from server.services.play.live_game import LiveGame, hold
from server.services.runtime.context import Context, Writing


def forfeit(context: Context, game_id: str, command: Command) -> Answer:
    """End a running game against one of its players; for the organiser alone."""
    with context.writing() as writing:
        live = hold(writing.connection, game_id)
        command.caller.require_organiser()
        answer = once(writing.connection, command, lambda: _ended(writing, live, command))
    context.wakeups.notify(live.agents)
    return answer


def _ended(writing: Writing, live: LiveGame, command: Command) -> Answer:
    if not live.is_running:
        raise GameFinished(f"game {live.id} is {live.row.status}")
    request = parse(command, ForfeitRequest)
    live = games.end_from_outside(writing, live, EndReason(request.reason), request.seat)
    return history.answer(writing.connection, live, None, writing.now)
