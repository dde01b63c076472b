"""`pooliad agent explain`: what `search` considers in a position, and why it chooses."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from client.cli.output import USAGE, Json, emit, fail, say
from client.cli.position import read_position
from client.cli.tables import NAMES, load_table

if TYPE_CHECKING:
    from client.agents.search.explaining import Explained
    from client.agents.search.options import Options
    from client.agents.search.thinking import Thought
    from referee import Action, EightBall, Game
    from referee.play import NoiseModel

SHOWN = 5
"""Finalists."""


def explain(
    file: Annotated[
        Path,
        typer.Argument(help="A record of a game, with --shot; or JSON with a position, as docs/protocol.md has it."),
    ],
    shot: Annotated[int | None, typer.Option(min=1, help="The stroke, by the number that `replay show` lists.")] = None,
    name: Annotated[str, typer.Option(help="search, with its options.")] = "search:shots=20000",
    noise: Annotated[
        float | None, typer.Option(min=0.0, max=5.0, help="Noise level; that of the record, or 1, unless given.")
    ] = None,
    table: Annotated[str, typer.Option(help=f"Of a position: {NAMES}, JSON, or a TOML file.")] = "olympiad",
    seed: Annotated[int, typer.Option(min=0, help="Repeats what is simulated.")] = 0,
    picture: Annotated[Path | None, typer.Option(help="Draw the choice: .svg, .png or .html, which moves.")] = None,
    as_json: Json = False,
) -> None:
    """Show which strokes `search` considers in a position, what each is worth, and which one it chooses."""
    from client.agents.search.explaining import explained, thought_about

    rules, game, model, played = _situation(file, shot, table)
    options = _options(name)
    try:
        thought = thought_about(rules, game, model if noise is None else replace(model, level=noise), options, seed)
    except ValueError as error:
        fail(str(error), USAGE)
    shown = [explained(rules, game, each) for each in thought.considered[:SHOWN]]
    if as_json:
        emit(_as_json(thought, shown))
    else:
        _tell(thought, shown, played)
    if picture is not None and shown:
        _draw(picture, shown[0])


def _situation(file: Path, shot: int | None, table: str) -> "tuple[EightBall, Game, NoiseModel, Action | None]":
    """Referee, game, noise, and the action played there if it is known. A file without a position ends the command."""
    from referee import EightBall
    from referee.play import NoiseModel

    if shot is not None:
        return _from_record(file, shot)
    return EightBall(load_table(table)), read_position(file), NoiseModel(), None


def _from_record(file: Path, shot: int) -> "tuple[EightBall, Game, NoiseModel, Action | None]":
    """The game of a record before one of its strokes."""
    from referee import RefereeError
    from referee.record import Header, read_record
    from tournament.luck.game import steps

    try:
        record = read_record(file)
        header = Header.from_dict(record.header)
        strokes = [step for step in steps(header.start, record.entries) if step[1].shot is not None]
    except (OSError, RefereeError, LookupError, TypeError, ValueError) as error:
        fail(f"{file} is no record of a game: {error}", USAGE)
    if shot > len(strokes):
        fail(f"--shot is {shot}; this game has strokes 1 to {len(strokes)}", USAGE)
    before, action, _ = strokes[shot - 1]
    return header.terms.rules, before, header.terms.noise, action


def _options(name: str) -> "Options":
    """The options of `search`; leaves the command for another agent."""
    from client.agents.registry import options_of
    from client.agents.search.options import Options
    from client.errors import AgentNotFound

    plain, _, given = name.partition(":")
    if plain != "search":
        fail(f"name = {name!r}: must be search, with options or without", USAGE)
    try:
        values: dict[str, Any] = options_of(name, given)
        return Options(**values)
    except (AgentNotFound, ValueError) as error:
        fail(str(error), USAGE)


def _tell(thought: "Thought", shown: "list[Explained]", played: "Action | None") -> None:
    """The finalists, a line each, and why the first was chosen."""
    say(f"{thought.simulated} shots simulated; without a pot the table is worth {thought.without_pot:.3f}")
    if not shown:
        say(f"nothing could be simulated: {_stroke(thought.action)}")
    for number, each in enumerate(shown, 1):
        known = each.stroke
        worth = f"{known.worth:.3f} ± {known.error:.3f} of {known.copies}"
        say(f"{number}  {worth:24} {each.kind:13} {_stroke(known.action)}")
    if len(shown) > 1:
        first, second = shown[0].stroke, shown[1].stroke
        ahead = first.worth - second.worth
        error = (first.error**2 + second.error**2) ** 0.5
        say(f"1 is chosen: {ahead:.3f} ahead of 2, {ahead / max(error, 1e-9):.1f} standard errors")
    if played is not None:
        say(f"played in the game: {_stroke(played)}")


def _stroke(action: "Action") -> str:
    """A stroke in a line."""
    from physics.constants import POCKET_NAMES
    from referee import Call

    shot = action.shot
    assert shot is not None
    call = action.call
    called = f"{call.ball} into {POCKET_NAMES[call.pocket]}" if isinstance(call, Call) else (call or "break")
    place = "" if action.cue_ball is None else f", cue ball at {action.cue_ball[0]:.3f}, {action.cue_ball[1]:.3f}"
    return (
        f"{called}: v {shot.v:.2f}, phi {shot.phi:.2f}, theta {shot.theta:.1f}, a {shot.a:.1f}, b {shot.b:.1f}{place}"
    )


def _as_json(thought: "Thought", shown: "list[Explained]") -> dict[str, Any]:
    """All of it."""
    return {
        "simulated": thought.simulated,
        "without_pot": thought.without_pot,
        "chosen": thought.action.to_dict(),
        "considered": [
            {
                "action": each.stroke.action.to_dict(),
                "kind": each.kind,
                "worth": each.stroke.worth,
                "error": each.stroke.error,
                "copies": each.stroke.copies,
                "made_as_meant": each.made,
            }
            for each in shown
        ],
    }


def _draw(file: Path, chosen: "Explained") -> None:
    """The stroke as it is meant."""
    from client.cli.drawing import draw
    from referee import Call

    call = chosen.stroke.action.call
    ring = (call.ball, call.pocket) if isinstance(call, Call) else None
    draw(file, chosen.result, chosen.stroke.action.shot, ring, f"{chosen.kind}, worth {chosen.stroke.worth:.3f}")
    say(f"{file}")
