"""`pooliad calibrate`: parameters of a table from paths of balls as a camera saw them."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from client.cli.output import USAGE, Json, emit, fail, say
from client.cli.tables import NAMES, load_table

if TYPE_CHECKING:
    from calibration import Calibration, ErrorModel, FittedLaw
    from calibration.matching import Observer


def calibrate(
    data: Annotated[Path, typer.Argument(help="Observed paths, CSV or JSON (docs/calibration.md).")],
    fit: Annotated[str, typer.Option(help="Parameters to fit, e.g. mu_slide,mu_roll,e_cushion.")],
    table: Annotated[
        str, typer.Option(help=f"Where the fit begins: {NAMES}, JSON with parameters, or a TOML file of them.")
    ] = "nine_foot",
    strokes: Annotated[Path | None, typer.Option(help="What the players meant, CSV: shot,v,phi,theta,a,b.")] = None,
    out: Annotated[Path | None, typer.Option(help="Write the fitted table into this TOML file.")] = None,
    noise_out: Annotated[
        Path | None, typer.Option(help="Write the players' standard deviations into this TOML file.")
    ] = None,
    report: Annotated[Path | None, typer.Option(help="Write a page with pictures into this HTML file.")] = None,
    laws: Annotated[str, typer.Option(help="Cushion laws to compare by these data, e.g. han,mathavan.")] = "",
    seed: Annotated[int, typer.Option(min=0, help="Of the starts that are drawn.")] = 0,
    as_json: Json = False,
) -> None:
    """Fit parameters of a table to observed paths, with intervals, and name the shots that the model does not explain.

    Leaves with 1 when the model does not explain the data; everything is written all the same.
    """
    from calibration import InvalidData, InvalidFit, compare_laws, error_model, read_paths
    from calibration import calibrate as run
    from calibration import report as page
    from physics.table_file import write_table

    start = load_table(table)
    names = [name.strip() for name in fit.split(",") if name.strip()]
    for name, file in (("out", out), ("noise-out", noise_out)):
        if file is not None and file.suffix != ".toml":
            fail(f"{name} = {str(file)!r}: must end in .toml", USAGE)
    try:
        observations = read_paths(data, start, strokes)
        found = run(start, observations, names, seed=seed, observer=_observer(as_json))
        wanted = [law.strip() for law in laws.split(",") if law.strip()]
        compared = compare_laws(start, observations, names, wanted, observer=_observer(as_json)) if wanted else ()
    except (InvalidData, InvalidFit) as error:
        fail(str(error), USAGE)
    except OSError as error:
        fail(f"{error.filename} cannot be read: {error.strerror}", USAGE)
    try:
        errors = error_model(observations.shots, found.shots)
    except InvalidFit as error:
        if noise_out is not None:
            fail(str(error), USAGE)
        errors = None  # too few strokes were told
    try:
        if out is not None:
            notes = (f"Fitted by pooliad calibrate to {len(found.shots)} shots of {data.name}.", *_notes(found))
            write_table(out, found.table, notes)
        if noise_out is not None and errors is not None:
            write_noise(noise_out, errors, data)
        if report is not None:
            title = f"Calibration of {start.name} by {data.name}"
            report.write_text(page(found, observations, title=title, laws=compared, errors=errors), encoding="utf-8")
    except OSError as error:
        fail(f"{error.filename} cannot be written: {error.strerror}", USAGE)
    if as_json:
        told = {"laws": [{"law": one.law, "worse": one.worse, "error": one.error} for one in compared]}
        emit(found.to_dict() | told | {"errors": None if errors is None else errors.to_dict()})
    else:
        _tell(found, compared, errors)
    if not found.is_trusted:
        raise typer.Exit(1)


def write_noise(file: Path, errors: "ErrorModel", data: Path) -> None:
    """The standard deviations that the data tell; the others are the Olympiad's."""
    from referee.play.noise import SIGMA_MAX, Sigmas
    from referee.play.noise_file import write_sigmas

    told = {name: min(errors.sigmas[name], SIGMA_MAX[name]) for name in SIGMA_MAX if errors.told[name]}
    notes = [f"Standard deviations of {errors.strokes} strokes of {data.name}, estimated by pooliad calibrate."]
    notes += [f"{name}: not told by these data; the Olympiad's." for name in SIGMA_MAX if name not in told]
    write_sigmas(file, Sigmas(**told), tuple(notes))


def _observer(quiet: bool) -> "Observer":
    """Progress as lines on standard error, where a person sees them."""
    if quiet or not sys.stderr.isatty():
        return lambda _words, _part: None
    return lambda words, part: print(f"{100.0 * part:3.0f} %  {words}", file=sys.stderr, flush=True)


def _notes(found: "Calibration") -> list[str]:
    return [f"{one.name}: {one.value:.6g}, 95 % from {one.low:.6g} to {one.high:.6g}" for one in found.estimates]


def _tell(found: "Calibration", laws: "tuple[FittedLaw, ...]", errors: "ErrorModel | None") -> None:
    from calibration.report import UNITS, verdict

    for one in found.estimates:
        note = "" if one.is_determined else "   not determined by these data"
        say(f"{one.name:24} {one.value:10.6g}   95 % from {one.low:.6g} to {one.high:.6g}{note}")
    for shot in found.unexplained:
        say(f"shot {shot.name} is not explained: {shot.why}")
    for law in laws:
        judged = ", refuted by these data" if law.is_refuted else ""
        say(f"law {law.law}: mean square worse by {law.worse:.2f} +- {law.error:.2f}{judged}")
    if errors is not None:
        for name, unit in UNITS.items():
            told = f"{errors.sigmas[name]:.3g} {unit}" if errors.told[name] else "not told by these data"
            say(f"error of {name}: {told}")
    say(verdict(found))
