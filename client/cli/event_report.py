"""`pooliad tournament report`: a page, games to watch, JSON and tables, written into an event's directory."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from client.cli.events import Event, ledger_of, opened
from client.cli.output import Json, emit, say

if TYPE_CHECKING:
    from tournament import GameResult
    from tournament.luck import GameLuck

REPLAYS = "replays"
"""Folder of an event's games as pages that play them."""


def report(
    directory: Event,
    luck: Annotated[
        bool,
        typer.Option("--luck", help="Simulate strokes with fresh noise, seconds a game, to tell luck."),
    ] = False,
    replays: Annotated[
        int, typer.Option(min=0, help="Games to write as pages that play them, the newest; some 40 KB each.")
    ] = 100,
    as_json: Json = False,
) -> None:
    """Write an event's report, finished or not: a page, games to watch, JSON, and tables, into its directory."""
    import json

    from client.arena.directory import write_whole
    from client.arena.remote import PLACE
    from tournament.report import csv_text, event_report, json_lines, page, turning_points

    event = opened(directory)
    played = ledger_of(event).event
    at_server = (directory / PLACE).exists()  # there a seed is chosen for tests alone, and nobody is rated
    rated = not (at_server and played.spec.foreseeable)
    records = {one.record: directory / one.record for one in played.counted if (directory / one.record).is_file()}
    moments = turning_points(records)
    watched = dict.fromkeys([*(one.record for one in moments), *reversed(records)][: replays + len(moments)])
    data = event_report(
        played,
        _luck(directory, played.counted) if luck else None,
        rated=rated,
        moments=moments,
        replays=_replays(directory, {name: records[name] for name in watched} if replays else {}),
    )
    texts = {
        "report.html": page(data),
        "report.json": json.dumps(data, ensure_ascii=False, allow_nan=False, indent=2) + "\n",
        "results.csv": csv_text(played.counted),
        "results.jsonl": "".join(f"{line}\n" for line in json_lines(played.counted)),
    }
    for name, text in texts.items():
        write_whole(directory / name, text.encode())
    if as_json:
        emit(data)
    else:
        say(f"{', '.join(texts)} in {directory}; open {directory / 'report.html'} in a browser")


def _luck(directory: Path, results: Sequence["GameResult"]) -> "dict[tuple[str, int], GameLuck]":
    """The luck of the games whose records lie in the directory."""
    from tournament.luck import game_luck

    files = {(one.pair, one.leg): directory / one.record for one in results if one.record}
    return {key: game_luck(path) for key, path in files.items() if path.is_file()}


def _replays(directory: Path, records: dict[str, Path]) -> dict[str, str]:
    """Write games as pages that play them; where each is, by its record."""
    from client.arena.directory import write_whole
    from tournament.report import replay

    (directory / REPLAYS).mkdir(exist_ok=True)
    found = {}
    for name, path in records.items():
        text = replay(path)
        if text is not None:
            found[name] = f"{REPLAYS}/{path.stem}.html"
            write_whole(directory / found[name], text.encode())
    return found
