"""The environments as Gymnasium's own machinery takes them: by name, checked, recorded."""

import subprocess
import sys
from importlib.util import find_spec

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from support.require import require

import client.learn
from client.learn import frames
from physics import Table

NAME = "client.learn:pooliad/EightBall-v0"
MIDDLE = np.zeros(8, np.float32)
"""The middle of every range: a stroke that moves the cue ball, as one drawn by chance need not."""


def test_an_environment_is_made_by_name():
    """Importing the package registers it; so does the name alone, in a program that imported nothing."""
    env = gymnasium.make("pooliad/EightBall-v0", table=Table.nine_foot())
    seen, _info = env.reset(seed=1)
    assert env.observation_space.contains(seen)
    program = f"import gymnasium; print(type(gymnasium.make({NAME!r}).unwrapped).__name__)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "EightBallEnv"


def test_so_are_many_at_once():
    many = gymnasium.make_vec("pooliad/EightBall-v0", num_envs=3)
    assert isinstance(many.unwrapped, client.learn.EightBallVectorEnv)
    seen, _info = many.reset(seed=1)
    assert seen.shape == (3, client.learn.OBSERVATION_SIZE)


@pytest.mark.parametrize("mode", ["ansi", "rgb_array"])
def test_gymnasium_finds_nothing_wrong(mode):
    check_env(gymnasium.make(NAME, render_mode=mode).unwrapped, skip_render_check=False)


def test_pixels_show_the_position():
    env = gymnasium.make(NAME, render_mode="rgb_array")
    env.reset(seed=2)
    before = env.render()
    assert isinstance(before, np.ndarray)
    assert before.dtype == np.dtype(np.uint8)
    assert before.shape[1:] == (640, 3)
    env.step(MIDDLE)
    after = env.render()
    assert isinstance(after, np.ndarray)
    assert after.shape == before.shape
    assert (after != before).any()


def test_what_can_be_drawn_is_said():
    with pytest.raises(ValueError, match="render_mode = 'video': must be 'ansi', 'rgb_array', 'human' or None"):
        client.learn.EightBallEnv(render_mode="video")


def test_a_window_shows_every_step(monkeypatch):
    """pygame's own driver for machines without a screen."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    pygame = pytest.importorskip("pygame")
    monkeypatch.setitem(client.learn.EightBallEnv.metadata, "render_fps", 1000)
    env = client.learn.EightBallEnv(render_mode="human")
    env.reset(seed=2)
    for _ in range(2):
        surface = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
        assert (surface == frames.pixels(env.game.state, env.table)).all()
        env.step(MIDDLE)
    env.close()
    assert not pygame.display.get_init()


def test_a_window_needs_pygame(monkeypatch):
    monkeypatch.setitem(sys.modules, "pygame", None)
    with pytest.raises(ImportError, match="render_mode = 'human': needs pygame"):
        client.learn.EightBallEnv(render_mode="human")


@pytest.mark.long
def test_a_game_becomes_a_video(tmp_path):
    require(find_spec("moviepy") is not None, "moviepy, which RecordVideo asks for")
    env = gymnasium.wrappers.RecordVideo(gymnasium.make(NAME, render_mode="rgb_array"), str(tmp_path / "video"))
    env.reset(seed=3)
    for _ in range(3):
        env.step(env.action_space.sample())
    env.close()
    (video,) = (tmp_path / "video").glob("*.mp4")
    assert video.stat().st_size > 1000


def test_a_shell_lists_what_there_is():
    assert {"EightBallEnv", "EightBallVectorEnv", "EightBallAEC", "observe", "act"} <= set(dir(client.learn))
