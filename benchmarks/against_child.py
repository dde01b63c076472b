"""One of the two processes that ``against`` compares: it plays scenes with the package that PYTHONPATH names.

Not imported: run by its path, so that ``physics`` may be another commit's. It uses only what every release has:
``simulate``, ``simulate_batch`` and ``physics.engine.kernels``. Commands come by line, answers go by line.
"""

import ctypes
import hashlib
import importlib
import json
import mmap
import pickle
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

START_INSTRUMENTATION, STOP_INSTRUMENTATION, DUMP_STATISTICS = 0x43540004, 0x43540005, 0x43540000
"""Callgrind's client requests (callgrind.h)."""

REQUEST = bytes.fromhex("4889f8 31d2 48c1c703 48c1c70d 48c1c73d 48c1c733 4887db 4889d0 c3")
"""x86-64: rax = the arguments' address, rdx = 0, then valgrind's preamble of four rotations and an exchange
(valgrind.h); outside valgrind it does nothing. Returns rdx."""

FACTS = (
    *("status", "n_events", "crossed_head_string", "crossed_before_contact", "first_contact", "cushion"),
    *("cushion_after_contact", "pocketed", "pocket", "off_table", "frozen_to_cushion", "frozen_to_cue_ball"),
    *("duration", "first_contact_cue_ball"),
)
"""The facts of version 0.1.0: what later ones know besides has nothing to be compared with."""


def client_request() -> Callable[[int], None]:
    """A function that makes a client request of valgrind."""
    page = mmap.mmap(-1, mmap.PAGESIZE, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
    page.write(REQUEST)
    code = ctypes.c_char.from_buffer(page)  # keeps the page
    call = ctypes.CFUNCTYPE(ctypes.c_uint64, ctypes.c_void_p)(ctypes.addressof(code))

    def request(number: int, _kept: Any = code) -> None:
        arguments = (ctypes.c_uint64 * 6)(number)
        call(ctypes.addressof(arguments))

    return request


def main(path: str) -> None:
    """Answer commands until the input ends."""
    importlib.import_module("numba")  # no part of compiling
    started = time.process_time()
    import physics
    from physics.engine import kernels

    imported = time.process_time()
    kernels()
    compiled = time.process_time() - imported
    with Path(path).open("rb") as file:
        scenes: dict[str, dict[str, Any]] = pickle.load(file)
    works = {name: work_of(physics, scene) for name, scene in scenes.items()}
    request = client_request()
    answer({"compile": compiled, "import": imported - started, "file": physics.__file__})
    for line in sys.stdin:
        command, _, name = line.strip().partition(" ")
        if command == "time":
            began = time.thread_time()
            works[name]()
            answer(time.thread_time() - began)
        elif command == "bits":
            answer(hash_of(works[name]()))
        elif command == "count":
            works[name]()
            request(START_INSTRUMENTATION)
            works[name]()
            request(DUMP_STATISTICS)  # before the stop, which forgets
            request(STOP_INSTRUMENTATION)
            answer(None)


def answer(value: Any) -> None:
    """One line of JSON."""
    print(json.dumps(value), flush=True)


def work_of(physics: Any, scene: dict[str, Any]) -> Callable[[], Any]:
    """A function that plays a scene: a batch, or the results of single calls with their traces."""
    table = physics.Table.from_dict(scene["table"])
    if not scene["traced"]:
        return lambda: physics.simulate_batch(table, scene["states"], scene["shots"])
    played = [
        (physics.TableState.from_positions(state), physics.Shot(*shot))
        for state, shot in zip(scene["states"], scene["shots"].tolist(), strict=True)
    ]
    return lambda: [physics.simulate(table, state, shot) for state, shot in played]


def hash_of(outputs: Any) -> str:
    """SHA-256 over all that a scene left: positions, pockets, statuses and facts, or every event of every trace."""
    total = hashlib.sha256()
    if not isinstance(outputs, list):
        facts = (outputs.facts[name] for name in FACTS)
        for array in (outputs.positions, outputs.pocket, outputs.status, *facts):
            total.update(array.tobytes())
        return total.hexdigest()
    for result in outputs:
        total.update(result.final.positions.tobytes())
        for event in result.events:
            total.update(repr(event.to_dict()).encode())
    return total.hexdigest()


if __name__ == "__main__":
    main(sys.argv[1])
