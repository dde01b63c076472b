"""The same bits on aarch64, another family of processors, under qemu's user mode. Interpreted it takes minutes.

It needs no whole machine: ``qemu-aarch64-static``; an unpacked arm64 root with Python (``debootstrap --arch=arm64
--foreign --variant=minbase --include=python3 bookworm ROOT``, then ``dpkg -x`` of the packages it fetched, into ROOT);
and a folder SITE of unpacked aarch64 wheels of what the scenes import (``pip download --only-binary=:all:
--python-version 3.11 --platform manylinux_2_28_aarch64 numpy numba llvmlite hypothesis mpmath``).
``POOLIAD_AARCH64=ROOT:SITE`` says where; ``POOLIAD_AARCH64_COMPILED=1`` compiles as well, which takes half an hour.
"""

import os
import shutil
import subprocess

import pytest
from support.require import ROOT, require

GOLDEN = ROOT / "tests" / "golden" / "shots.txt"


def emulated(interpreted: bool, cache: str) -> str:
    """What ``support.bits`` writes there."""
    qemu, (root, site) = shutil.which("qemu-aarch64-static"), os.environ["POOLIAD_AARCH64"].split(":")
    settings = {
        "PYTHONPATH": f"{ROOT / 'tests'}:{ROOT}:{site}",
        "NUMBA_DISABLE_JIT": str(int(interpreted)),
        "POOLIAD_CACHE_DIR": cache,
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    given = [part for name, value in settings.items() for part in ("-E", f"{name}={value}")]
    command = [str(qemu), "-L", root, *given, f"{root}/usr/bin/python3.11", "-m", "support.bits"]
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT).stdout


@pytest.mark.long
@pytest.mark.parametrize("interpreted", [True, False], ids=["interpreted", "compiled"])
def test_bits_of_aarch64(interpreted, tmp_path):
    require(shutil.which("qemu-aarch64-static") is not None, "qemu-aarch64-static")
    require("POOLIAD_AARCH64" in os.environ, "an arm64 root, named by POOLIAD_AARCH64")
    require(interpreted or "POOLIAD_AARCH64_COMPILED" in os.environ, "POOLIAD_AARCH64_COMPILED, for half an hour")
    assert sorted(emulated(interpreted, str(tmp_path)).splitlines()) == sorted(GOLDEN.read_text().splitlines())
