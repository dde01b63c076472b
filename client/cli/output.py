"""How commands speak: tables and sentences for people, one JSON value for programs, exit codes for both.

Exit codes: 0 it worked; 1 a match, a verification or an environment failed; 2 wrong usage.
"""

import json
import math
import sys
from typing import Annotated, Any, NoReturn

import typer

FAILED = 1
USAGE = 2

Json = Annotated[bool, typer.Option("--json", help="Print one JSON value instead of text.")]


def say(text: str = "") -> None:
    """Print a line for people, at once, so that progress is seen when standard output is a pipe."""
    print(text, flush=True)


def emit(value: Any) -> None:
    """Print a JSON value on standard output; numbers that JSON lacks become null."""
    print(json.dumps(_plain(value), ensure_ascii=False, indent=2, allow_nan=False), flush=True)


def fail(message: str, code: int = FAILED) -> NoReturn:
    """Say on standard error what went wrong and leave."""
    print(f"pooliad: {message}", file=sys.stderr, flush=True)
    raise typer.Exit(code)


def _plain(value: Any) -> Any:
    """The value with NaN and infinities replaced by None."""
    if isinstance(value, dict):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
