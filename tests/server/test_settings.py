"""Settings: docs/operations.md. Defaults, a file, the environment, the command line; each over the one before."""

import os
import subprocess
import sys
import tomllib

import pytest

from server.errors import SettingsError
from server.settings import SECRET, Settings, effective, settable

TOKEN = "t" * 40


def file_of(tmp_path, text):
    path = tmp_path / "pooliad.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_each_source_goes_over_the_one_before(tmp_path):
    config = file_of(tmp_path, 'database = "sqlite:///file.db"\nbody_limit = 1\nlag_turn = 0\nlongest_wait = 3\n')
    environment = {"POOLIAD_DATABASE": "sqlite:///environment.db", "POOLIAD_BODY_LIMIT": "2"}
    found = effective(config, environment, {"database": "sqlite:///option.db", "body_seconds": None})
    assert found.settings.database == "sqlite:///option.db"
    assert (found.settings.body_limit, found.settings.lag_turn, found.settings.longest_wait) == (2, 0.0, 3.0)
    assert found.sources == {
        "database": "option",
        "body_limit": "environment",
        "lag_turn": "file",
        "longest_wait": "file",
    }


def test_what_is_printed_is_a_file_that_means_the_same(tmp_path):
    found = effective(None, {"POOLIAD_PUBLIC_READS": "no", "POOLIAD_HOUSE_BOTS": 'a="b\\c'})
    again = effective(file_of(tmp_path, str(found).replace(f'{SECRET} = ""', "")))
    assert again.settings == found.settings


def test_secrets_are_masked_in_what_is_printed():
    environment = {"POOLIAD_ORGANISER_TOKEN": TOKEN, "POOLIAD_DATABASE": "postgresql://ann:pass@word@host/name"}
    printed = str(effective(None, environment))
    assert TOKEN not in printed
    assert "pass" not in printed
    assert "word" not in printed
    assert tomllib.loads(printed)[SECRET] == "***"


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("bodylimit = 1", "setting 'bodylimit': must be one of "),
        ("body_limit = 1.5", "body_limit = 1.5: must be a whole number"),
        ("body_limit = true", "body_limit = True: must be a whole number"),
        ("public_reads = 1", "public_reads = 1: must be true or false"),
        ("timer_period = 0", "timer_period = 0.0: must be a finite number above 0"),
        ("lag_turn = -1", "lag_turn = -1.0: must be a finite number"),
        ("timer_period = nan", "timer_period = nan"),
        ('registration = "maybe"', "registration = 'maybe': must be one of open, invited, closed"),
        (f'{SECRET} = "short"', "at least 32"),
        (
            'frame_ancestors = "https://a.org; script-src *"',
            "frame_ancestors = 'https://a.org; script-src *': must be ",
        ),
        ('frame_ancestors = "javascript:"', "frame_ancestors = 'javascript:': must be origins such as"),
        ("timer_period = ", "no TOML file"),
        ("[timer]\nperiod = 1", "setting 'timer': must be"),
    ],
)
def test_a_bad_setting_in_the_file_is_named(tmp_path, text, named):
    with pytest.raises(SettingsError) as error:
        effective(file_of(tmp_path, text))
    assert named in str(error.value)


@pytest.mark.parametrize(
    ("name", "text", "named"),
    [("PUBLIC_READS", "perhaps", "POOLIAD_PUBLIC_READS = 'perhaps': must be true or false")],
)
def test_a_bad_variable_is_named(name, text, named):
    with pytest.raises(SettingsError, match=named):
        Settings.from_environment({f"POOLIAD_{name}": text})


def test_the_command_prints_the_effective_configuration_and_leaves(tmp_path):
    config = file_of(tmp_path, f'body_limit = 77\n{SECRET} = "{TOKEN}"\n')
    command = [sys.executable, "-m", "client.cli", "serve", "--config", str(config), "--print-config"]
    environment = os.environ | {"POOLIAD_TIMER_PERIOD": "0.5"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=True)
    assert "body_limit = 77  # file" in done.stdout
    assert "timer_period = 0.5  # environment" in done.stdout
    assert "fetch_grace = 1.0  # default" in done.stdout
    assert TOKEN not in done.stdout
    assert set(tomllib.loads(done.stdout)) == {field.name for field in settable()} | {SECRET}


def test_a_file_that_is_not_there_is_an_error_in_words(tmp_path):
    command = [sys.executable, "-m", "server", "--port", "0", "--config", str(tmp_path / "none.toml")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 1
    assert "none.toml" in done.stderr
    assert "Traceback" not in done.stderr
