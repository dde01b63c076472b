"""Other versions of Python on this machine, for what must be the same on all of them."""

import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

from support.require import require


@cache
def _found(version: str) -> str | None:
    """An interpreter of a version that runs; the one that runs the tests before any other."""
    root = Path(os.environ.get("PYENV_ROOT", "~/.pyenv")).expanduser()
    places = [sys.executable, shutil.which(f"python{version}")]
    places += sorted(map(str, root.glob(f"versions/{version}.*/bin/python{version}")))
    question = ["-I", "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
    for place in filter(None, places):
        done = subprocess.run([place, *question], capture_output=True, text=True, check=False)
        if done.stdout.strip() == version:
            return place
    return None


def python(version: str) -> str:
    """An interpreter of a version like `3.12`; skips the test without one."""
    found = _found(version)
    require(found is not None, f"Python {version}")
    assert found is not None
    return found
