"""The import contracts hold, and name every module they are about."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from support.require import ROOT, require

CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]["contracts"]


def test_the_import_contracts_hold():
    program = shutil.which("lint-imports", path=str(Path(sys.executable).parent))
    require(program is not None, "import-linter")
    done = subprocess.run([program, "--no-cache"], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_kernels_are_kept_from_every_other_module_of_the_physics():
    """A module added to physics has to be added to the contract."""
    (contract,) = [each for each in CONTRACTS if each.get("source_modules") == ["physics.kernels"]]
    others = {f"physics.{path.stem}" for path in (ROOT / "physics").glob("[!_]*.py")}
    assert others <= set(contract["forbidden_modules"])
