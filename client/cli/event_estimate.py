"""What an event will take, said before it is played."""

from typing import TYPE_CHECKING

from client.cli.output import emit, say

if TYPE_CHECKING:
    from client.arena.terms import Terms


def say_estimate(terms: "Terms", workers: int | None, as_json: bool) -> None:
    """Say what the event will take."""
    from client.arena.estimate import estimate
    from client.arena.executors import cores

    found = estimate(terms, workers or cores())
    if as_json:
        emit(found.to_dict())
        return
    games = f"{found.games[0]}" if found.games[0] == found.games[1] else f"{found.games[0]} to {found.games[1]}"
    say(f"{terms.spec.name}: {len(terms.spec.entrants)} entrants, {terms.spec.format}, {games} games")
    if found.seconds is not None:
        low, high = (_duration(each) for each in found.seconds)
        span = low if low == high else f"{low} to {high}"
        say(
            f"about {span} with {found.workers} workers ({found.sampled} sample games, {found.game_seconds:.1f} s each)"
        )
    if found.longest_seconds is not None:
        say(f"at most {_duration(found.longest_seconds)}, if everybody used the whole clock")


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s" if minutes else f"{rest} s"
