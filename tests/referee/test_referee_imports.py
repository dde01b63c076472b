"""Importing the referee is light: kernels and the wire load when they are used."""

import subprocess
import sys

import referee


def test_import_loads_no_numba_scipy_or_pydantic() -> None:
    code = "import sys, referee; print(*sorted({name.split('.')[0] for name in sys.modules}))"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    assert "referee" in loaded
    assert not {"numba", "llvmlite", "scipy", "pydantic", "fastapi", "sqlalchemy"} & set(loaded)


def test_public_names_exist() -> None:
    assert referee.__all__ == sorted(
        referee.__all__, key=lambda name: (not name.isupper(), not name[0].isupper(), name)
    )
    for name in referee.__all__:
        assert getattr(referee, name) is not None
    assert not set(referee.__all__) - set(dir(referee))
