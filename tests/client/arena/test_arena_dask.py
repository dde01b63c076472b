"""Events on a Dask cluster: a real scheduler, two worker processes of one thread each, one killed in the middle."""

import os
import subprocess
import sys
import time
from importlib.util import find_spec
from typing import Any

import pytest
from support.require import require

from client.arena.directory import EventDirectory
from client.arena.executors import InProcess, pool_of
from client.arena.runner import Runner
from client.arena.terms import Terms

CUP = {
    "name": "cup",
    "entrants": ["random", {"name": "other", "agent": "random"}],
    "pairs": 4,
    "seconds": None,
    "seed": 3,
}


@pytest.fixture
def cluster(tmp_path):
    """Address of a scheduler, and its two workers' processes."""
    require(find_spec("distributed") is not None, "distributed, of the cluster extra")
    address_file = tmp_path / "scheduler.json"
    started: list[Any] = []
    environment = os.environ | {"DASK_DISTRIBUTED__WORKER__MEMORY__TERMINATE": "False", "PYTHONWARNINGS": "ignore"}

    def start(program, *arguments):
        log = (tmp_path / f"{len(started)}.log").open("wb")
        command = [
            sys.executable,
            "-m",
            f"distributed.cli.{program}",
            "--scheduler-file",
            str(address_file),
            *arguments,
        ]
        started.append(subprocess.Popen([*command, *arguments], stdout=log, stderr=subprocess.STDOUT, env=environment))
        log.close()
        return started[-1]

    start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    options = ("--nthreads", "1", "--nworkers", "1", "--no-nanny", "--no-dashboard", "--memory-limit", "0")
    workers = [start("dask_worker", *options) for _ in range(2)]
    while not address_file.exists() or not address_file.read_text().strip():
        time.sleep(0.05)
    import json

    yield json.loads(address_file.read_text())["address"].removeprefix("tcp://"), workers
    for process in reversed(started):
        process.kill()
        process.wait()


def begin(path):
    return EventDirectory.create(path, Terms.from_dict(CUP).to_dict())


def files(directory):
    return {path.name: path.read_bytes() for path in directory.games.glob("*.json*")}


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_a_worker_killed_in_the_middle_loses_nothing_and_nothing_is_played_twice(tmp_path, cluster):
    address, workers = cluster
    reference = begin(tmp_path / "reference")
    counted = Runner(reference, InProcess()).run().event.counted
    directory, begun = begin(tmp_path / "cup"), set()

    def kill_one(ledger, running):
        if ledger.event.counted and running and workers[0].poll() is None:
            workers[0].kill()
            begun.add("killed")

    with pool_of(f"dask://{address}") as pool:
        ledger = Runner(directory, pool, kill_one).run()
    assert begun == {"killed"}
    assert ledger.event.finished
    assert ledger.event.counted == counted
    assert files(directory) == files(reference)
    results = [entry.fields["result"] for entry in directory.journal.new() if entry.kind == "game"]
    assert len({(one["pair"], one["leg"]) for one in results}) == len(results) == 8
