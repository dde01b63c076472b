"""`pooliad doctor`: is everything here that playing needs, and which of it is it?"""

from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

from client.cli.output import Json, emit, fail, say

if TYPE_CHECKING:
    from pathlib import Path

PACKAGES = ("physics", "referee", "tournament", "server", "client")
LIBRARIES = ("numpy", "numba", "pydantic", "httpx2", "typer", "rich")
SERVER_LIBRARIES = ("fastapi", "uvicorn", "sqlalchemy", "alembic", "prometheus_client")

SQLITE_MAGIC: Final = b"SQLite format 3\0"
"""The first bytes of a database's file (https://sqlite.org/fileformat.html, 1.3)."""


def doctor(
    port: Annotated[int, typer.Option(min=1, max=65535, help="Port that `serve` would use.")] = 8080,
    database: Annotated[
        str, typer.Option(envvar="POOLIAD_DATABASE", help="Database that `serve` would use.")
    ] = "sqlite:///pooliad.db",
    jaws: Annotated[
        bool,
        typer.Option("--jaws", help="Compile and test the physics of tables with jaws too; it takes minutes, once."),
    ] = False,
    as_json: Json = False,
) -> None:
    """Show versions, where packages load from, the kernel cache, database, port, and a self-test.

    Leaves with 1 when something that playing needs does not work.
    """
    report = {
        "versions": _versions(),
        "packages": {name: _origin(name) for name in PACKAGES},
        "kernel_cache": _kernel_cache(),
        "record_engine": _record_engine(),
        "database": _database(database),
        "port": _port(port),
        "self_test": _self_test(jaws=False),
    }
    if jaws or report["kernel_cache"]["with_jaws"] == "compiled":
        report["self_test_with_jaws"] = _self_test(jaws=True)
    faults = _faults(report)
    if as_json:
        emit(report | {"ok": not faults, "faults": faults})
    else:
        _tell(report)
    if faults:
        fail("; ".join(faults))


def show_version(asked: bool) -> None:
    """Print this distribution's version and leave, if that was asked for."""
    from importlib import metadata

    if asked:
        say(f"pooliad {metadata.version('pooliad')}")
        raise typer.Exit


def _versions() -> dict[str, str | None]:
    """Version of Python, of this distribution and of its libraries; None where one is not installed."""
    import platform
    from importlib import metadata

    versions: dict[str, str | None] = {"python": platform.python_version(), "platform": platform.platform()}
    for name in ("pooliad", *LIBRARIES, *SERVER_LIBRARIES):
        try:
            versions[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            versions[name] = None
    return versions


def _origin(package: str) -> str | None:
    """The folder a package loads from."""
    from importlib.util import find_spec

    spec = find_spec(package)
    places = list(spec.submodule_search_locations or []) if spec is not None else []
    return places[0] if places else None


def _kernel_cache() -> dict[str, Any]:
    """Where compiled kernels are kept, and whether they are there already."""
    from physics.engine import cache_folder, digest, is_compiled

    folder = cache_folder()
    state = "no folder can be written" if folder is None else "filled" if any(folder.iterdir()) else "empty"
    with_jaws = "compiled" if is_compiled(jaws=True) else "compiled when a table asks"
    names = {"folder": None if folder is None else str(folder), "state": state, "with_jaws": with_jaws}
    return names | {"kernels_digest": digest()}


def _record_engine() -> dict[str, str]:
    """What records made here name as their engine."""
    from referee.record import this_engine

    return this_engine().to_dict()


def _database(url: str) -> dict[str, Any]:
    """Whether the database's file is there, or could be made; what it is, and which of its files others may read."""
    import os
    from pathlib import Path

    if not url.startswith("sqlite:///"):
        return {"url": url, "exists": None, "usable": None, "sqlite": None, "open_to_others": []}
    path = Path(url.removeprefix("sqlite:///")).resolve()
    writable = os.access(path if path.exists() else path.parent, os.W_OK)
    there = {"url": url, "exists": path.exists(), "usable": writable}
    return there | {"sqlite": _is_sqlite(path), "open_to_others": _open_to_others(path)}


def _is_sqlite(path: "Path") -> bool | None:
    """Whether a file is an SQLite database, or empty, to become one; None when there is none that can be read."""
    try:
        with path.open("rb") as file:
            return file.read(len(SQLITE_MAGIC)) in (b"", SQLITE_MAGIC)
    except OSError:
        return None


def _open_to_others(path: "Path") -> list[str]:
    """The files of an SQLite database that others than the owner may read or write, each with its mode."""
    import stat

    files = [path.with_name(path.name + suffix) for suffix in ("", "-wal", "-shm", "-journal")]
    modes = {file: stat.S_IMODE(file.stat().st_mode) for file in files if file.exists()}
    return [f"{file} ({mode:04o})" for file, mode in modes.items() if mode & (stat.S_IRWXG | stat.S_IRWXO)]


def _port(port: int) -> dict[str, Any]:
    """Whether a server could listen on the port."""
    import socket

    try:
        with socket.create_server(("127.0.0.1", port)):
            return {"port": port, "free": True}
    except OSError:
        return {"port": port, "free": False}


def _self_test(jaws: bool) -> dict[str, Any]:
    """The physics' own, and how long it took: the first time with the compiler."""
    import time

    from physics.self_test import self_test

    started = time.perf_counter()
    result = self_test(jaws)
    seconds = round(time.perf_counter() - started, 3)
    return {"ok": result.ok, "digest": result.digest, "events": result.events, "seconds": seconds}


def _faults(report: dict[str, Any]) -> list[str]:
    """What does not work, in words."""
    faults = [f"{name} is not installed" for name in LIBRARIES if report["versions"][name] is None]
    faults += [f"package {name} is not found" for name in PACKAGES if report["packages"][name] is None]
    if not all(report[name]["ok"] for name in ("self_test", "self_test_with_jaws") if name in report):
        faults.append("the physics gives two answers to the same shot")
    if report["database"]["usable"] is False:
        faults.append(f"the database {report['database']['url']} cannot be written")
    if report["database"]["sqlite"] is False:
        faults.append(f"database = {report['database']['url']}: must be an SQLite database or a new file")
    if exposed := report["database"]["open_to_others"]:
        faults.append(
            f"others may read the signing key and the seeds of running games in {', '.join(exposed)}: must be 0600 "
            "(chmod 600)"
        )
    return faults


def _tell(report: dict[str, Any]) -> None:
    """The report, for people."""
    for section, values in report.items():
        for name, value in values.items():
            say(f"{section.replace('_', ' '):14s}{name.replace('_', ' '):26s}{_shown(value)}")


def _shown(value: Any) -> str:
    """A value in a word."""
    if value is None:
        return "missing"
    if isinstance(value, list):
        return ", ".join(value) or "none"
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else str(value)
