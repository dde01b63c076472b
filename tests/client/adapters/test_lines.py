"""`LineProcess`: a command spoken to in lines, by tournaments and by `stdio:COMMAND` alike."""

import sys
import time

import pytest

from client.adapters.lines import Flooded, Left, LineProcess, Silent


@pytest.fixture
def speak(tmp_path):
    """Starts lines of Python as a command."""
    started = []

    def start(program, **options):
        words = f"import os, sys, time\n{program}"
        started.append(LineProcess([sys.executable, "-c", words], tmp_path / "errors", **options))
        return started[-1]

    yield start
    for process in started:
        process.kill()


def soon(seconds=20.0):
    return time.monotonic() + seconds


def written(process, **how):
    """What it has written unasked, as soon as there is something."""
    end = soon()
    while not (found := process.unasked(**how)) and time.monotonic() < end:
        time.sleep(0.01)
    return found


HALF = """
print("late\\nha", end="", flush=True)
input()
print("lf\\nanswer", flush=True)
input()
"""


def test_a_line_that_was_begun_unasked_is_no_answer(speak):
    process = speak(HALF)
    assert written(process) == ["late", "ha"]
    process.send("turn", soon())
    assert process.receive(soon()) == "answer"


@pytest.mark.parametrize(
    ("program", "kind", "words"),
    [
        ("print('sorry', file=sys.stderr); sys.exit(3)", Left, "bot left with exit code 3; .* ends: sorry"),
        ("os.kill(os.getpid(), 9)", Left, "left with signal SIGKILL"),
        ("if os.fork() == 0: time.sleep(30)\nos._exit(0)", Left, "left with exit code 0"),
        ("time.sleep(30)", Silent, "bot gave no answer in time"),
        ("print('x' * 5000, flush=True); time.sleep(30)", Flooded, "bot wrote more than 4000 bytes"),
    ],
    ids=["exits", "killed", "a child holds its output", "silent", "floods"],
)
def test_every_failure_is_told_apart(speak, program, kind, words):
    process = speak(program, name="bot", longest=4000)
    with pytest.raises(kind, match=words):
        process.receive(soon(1.5 if kind is Silent else 20.0))


def test_a_command_that_does_not_read_is_silent_too(speak):
    process = speak("time.sleep(30)")
    with pytest.raises(Silent, match="does not read"):
        process.send("x" * 10_000_000, soon(1.0))


def test_which_end_it_closed_is_said(speak):
    process = speak("os.close(0); print('closed', flush=True); time.sleep(30)", name="bot")
    assert process.receive(soon()) == "closed"
    with pytest.raises(Left, match="bot closed its standard input"):
        process.send("turn", soon())
    process = speak("os.close(1); time.sleep(30)", name="bot")
    with pytest.raises(Left, match="bot closed its standard output"):
        process.receive(soon())


def test_what_a_closed_output_has_left_unread_is_there_at_once(speak):
    """Seen: two seconds went by to find out how the command had ended, and nobody was told."""
    process = speak("print('bye', flush=True); os.close(1); time.sleep(30)")
    assert written(process) == ["bye"]
    time.sleep(0.1)
    begun = time.monotonic()
    assert process.unasked() == []
    assert time.monotonic() - begun < 1.0


def test_of_a_flood_unasked_the_forbearing_read_the_beginning(speak):
    flood = "while True: os.write(1, b'x' * 99 + b'\\n')"
    process = speak(flood, name="bot", longest=200_000)
    assert 0 < len(written(process, forbearing=True)) <= 2001
    process = speak(flood, name="bot", longest=1000)
    with pytest.raises(Flooded, match="bot wrote more than 1000 bytes"):
        written(process)
