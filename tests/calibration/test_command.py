"""`pooliad calibrate`: from files to a table and a page, in a process of its own."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from calibration import ErrorModel
from calibration.synthetic import seen
from calibration.writing import paths_csv, strokes_csv
from client.cli.calibrate import write_noise
from physics import Table
from physics.table_file import read_table
from referee.play.noise import Sigmas
from referee.play.noise_file import read_sigmas

TRUTH = Table.olympiad().replace(mu_slide=0.23)


def command(*words, cwd):
    return subprocess.run(
        [sys.executable, "-m", "client.cli", *words], cwd=cwd, capture_output=True, text=True, check=False, timeout=500
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("calibrate")
    observations = seen(TRUTH, 3, np.random.default_rng(8))
    (place / "paths.csv").write_text(paths_csv(observations))
    (place / "strokes.csv").write_text(strokes_csv(observations))
    return place


@pytest.fixture(scope="module")
def done(folder):
    words = ("paths.csv", "--strokes", "strokes.csv", "--table", "olympiad", "--fit", "mu_slide")
    return command("calibrate", *words, "--out", "my_table.toml", "--report", "report.html", cwd=folder)


def test_a_table_is_written_that_commands_accept(folder, done):
    assert done.returncode == 0, done.stderr
    assert "The model explains 3 of 3 shots" in done.stdout
    assert read_table(folder / "my_table.toml").mu_slide == pytest.approx(0.23, abs=0.005)
    words = ("--v", "2", "--phi", "270", "--balls", "0:0.5,1.7 3:0.4,0.6", "--table", "my_table.toml")
    shot = command("simulate", *words, cwd=folder)
    assert shot.returncode == 0, shot.stderr


def test_the_report_shows_every_shot_and_needs_nothing_else(folder, done):
    page = (folder / "report.html").read_text()
    assert page.count("<figure>") == 3
    assert "mu_slide" in page
    assert "<script" not in page
    assert "src=" not in page


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("paths.csv", "--fit", "mu_glide"), "fit = 'mu_glide': must be different ones of"),
        (("lost.csv", "--fit", "mu_slide"), "lost.csv cannot be read"),
        (
            ("paths.csv", "--fit", "mu_slide", "--noise-out", "noise.json"),
            "noise-out = 'noise.json': must end",
        ),
        (("paths.csv", "--fit", "mu_slide", "--out", "x.txt"), "out = 'x.txt': must end in .toml"),
        (("bad.csv", "--fit", "mu_slide"), "bad.csv, line 5, column x = 'here': must be a number"),
    ],
)
def test_what_is_wrong_is_one_sentence(folder, words, said):
    (folder / "bad.csv").write_text("# length = mm\n# time = s\n# frame = corner\nshot,t,ball,x,y\n1,0,0,here,2\n")
    refused = command("calibrate", *words, "--table", "olympiad", cwd=folder)
    assert refused.returncode == 2
    assert said in refused.stderr
    assert "Traceback" not in refused.stderr


def test_a_players_noise_is_written_as_far_as_the_data_tell_it(tmp_path):
    """Elevation is often not told: then it is the Olympiad's, and the file says so."""
    sigmas = {"v": 0.05, "phi": 0.2, "theta": 3.0, "a": 1.0, "b": 11.0}
    told = {name: name != "theta" for name in sigmas}
    nothing = dict.fromkeys(sigmas, (0.0, 0.0))
    errors = ErrorModel(12, sigmas, nothing, dict.fromkeys(sigmas, 0.0), np.eye(5), told)
    write_noise(tmp_path / "noise.toml", errors, Path("paths.csv"))
    assert read_sigmas(tmp_path / "noise.toml") == Sigmas(v=0.05, phi=0.2, a=1.0, b=10.0)
    assert "# theta: not told by these data" in (tmp_path / "noise.toml").read_text()
