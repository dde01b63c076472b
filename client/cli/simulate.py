"""`pooliad simulate`: what one shot does."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from client.cli.output import USAGE, Json, emit, fail, say
from client.cli.tables import NAMES, load_table

if TYPE_CHECKING:
    from physics import Result, Shot, Table, TableState


def simulate(
    v: Annotated[float, typer.Option("--v", help="Cue speed, m/s.")],
    phi: Annotated[float, typer.Option("--phi", help="Azimuth, deg, counter-clockwise from +x.")],
    theta: Annotated[
        float | None, typer.Option("--theta", help="Cue elevation, deg; the least possible unless given.")
    ] = None,
    a: Annotated[float, typer.Option("--a", help="Tip offset to the right, mm.")] = 0.0,
    b: Annotated[float, typer.Option("--b", help="Tip offset upwards, mm.")] = 0.0,
    balls: Annotated[
        str | None,
        typer.Option(help="Where the balls lie: 0:0.5,1.7 3:0.4,0.6 or JSON, or @FILE with either."),
    ] = None,
    rack: Annotated[int | None, typer.Option(min=0, help="A fresh 8-ball rack from this seed instead.")] = None,
    table: Annotated[str, typer.Option(help=f"{NAMES}, JSON with parameters, or a TOML file of them.")] = "olympiad",
    picture: Annotated[
        Path | None, typer.Option(help="Draw the shot into this file too: .svg, .png or .html, which moves.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Simulate one shot and print its events."""
    import math
    import sys

    from client.cli.drawing import draw
    from client.geometry.aim import looks_like_radians
    from physics import InvalidShot, InvalidState, Shot, check, min_elevation
    from physics import simulate as run
    from pictures import described

    cloth = load_table(table)
    try:
        state = _state(cloth, balls, rack)
        least = min_elevation(cloth, state, phi, a, b)
        if theta is None and math.isnan(least):
            fail(f"the cue is blocked at every elevation up to {cloth.theta_max:g} deg", USAGE)
        shot = Shot(v, phi, least if theta is None else theta, a, b)
        unplayable = check(cloth, state, shot)
    except (InvalidShot, InvalidState) as error:
        fail(str(error), USAGE)
    if unplayable is not None:
        fail(f"this shot cannot be played: {unplayable.reason}", USAGE)
    if looks_like_radians(phi):
        print(
            f"pooliad: note: --phi is in degrees; {phi:g} rad would be --phi {math.degrees(phi):.6g}", file=sys.stderr
        )
    result = run(cloth, state, shot)
    if picture is not None:
        draw(picture, result, shot, None, described(result))
    if as_json:
        emit(_value(shot, result))
    else:
        _tell(shot, result)


def _state(table: "Table", balls: str | None, rack: int | None) -> "TableState":
    """Where the balls lie at the start."""
    from physics import rack as racked

    if (balls is None) == (rack is None):
        fail("give exactly one of --balls and --rack", USAGE)
    return _read_balls(balls) if balls is not None else racked(table, "eight_ball", seed=rack or 0)


def _read_balls(text: str) -> "TableState":
    """A position from its notation or from JSON, given or in a file."""
    from client import notation
    from physics import TableState

    if text.startswith("@"):
        try:
            text = Path(text[1:]).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            fail(f"{text[1:]} cannot be read: {error}", USAGE)
    if text.lstrip().startswith("{"):
        return TableState.from_dict(_json("--balls", text))
    return notation.read(text)


def _json(option: str, text: str) -> Any:
    """The JSON value of an option."""
    import json

    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        fail(f"{option} is not JSON: {error}", USAGE)


def _value(shot: "Shot", result: "Result") -> dict[str, object]:
    """Everything, as JSON."""
    return {
        "shot": shot.to_dict(),
        "status": result.status.name.lower(),
        "duration": result.duration,
        "events": [event.to_dict() for event in result.events],
        "final": result.final.to_dict(),
    }


def _tell(shot: "Shot", result: "Result") -> None:
    """Everything, for people."""
    from client import notation

    say(f"v {shot.v:g} m/s  phi {shot.phi:g}  theta {shot.theta:.4g} deg  a {shot.a:g}  b {shot.b:g} mm")
    for event in result.events:
        say(str(event))
    say(f"after {result.duration:.3f} s: {notation.write(result.final)}")
