"""The game as an environment for learning, over the referee and the stroke that servers play with.

`EightBallAEC` is a PettingZoo environment of both players, `EightBallEnv` a Gymnasium one against an opponent,
`EightBallVectorEnv` many of those at once; `PotActions` wraps one whose actions are open pots, with a mask. They need
the `learn` extra; `observe`, `act` and its inverse `encode`, which they share, do not.

An observation is `OBSERVATION_SIZE` numbers in [0, 1] (see `observe`), an action `ACTION_SIZE` numbers in [-1, 1]:

=========== ========================================================================================
speed       0 to the table's `v_max`
direction   `phi`, 0 to 360 degrees; where the cue is blocked, turned on in steps of 5 degrees
elevation   the least that is free to the table's `theta_max`, by the square of the share
side        the tip's `a`, -14 to 14 mm
height      the tip's `b`, -14 to 14 mm
place_x     where a cue ball in hand goes, over the table or the kitchen; else ignored
place_y     the same, along the table
choice      the call: each ball that may be called into each pocket, at the end a safety; or the decision
=========== ========================================================================================

Importing this package registers both with Gymnasium: `gymnasium.make("client.learn:pooliad/EightBall-v0")`, and
`gymnasium.make_vec` of the same name.
"""

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from client.learn.aec import EightBallAEC
    from client.learn.codec import ACTION_NAMES, ACTION_SIZE, OBSERVATION_SIZE, act, encode, observe
    from client.learn.pots import PotActions
    from client.learn.single import EightBallEnv
    from client.learn.vector import EightBallVectorEnv

__all__ = [
    "ACTION_NAMES",
    "ACTION_SIZE",
    "OBSERVATION_SIZE",
    "EightBallAEC",
    "EightBallEnv",
    "EightBallVectorEnv",
    "PotActions",
    "act",
    "encode",
    "observe",
]

_HOMES = {
    "ACTION_NAMES": "codec",
    "ACTION_SIZE": "codec",
    "OBSERVATION_SIZE": "codec",
    "act": "codec",
    "encode": "codec",
    "observe": "codec",
    "EightBallAEC": "aec",
    "EightBallEnv": "single",
    "EightBallVectorEnv": "vector",
    "PotActions": "pots",
}


def __dir__() -> list[str]:
    return __all__


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'client.learn' has no attribute {name!r}; it exports {', '.join(__all__)}")
    return getattr(importlib.import_module(f"client.learn.{_HOMES[name]}"), name)


if importlib.util.find_spec("gymnasium") is not None:
    from gymnasium.envs.registration import register

    register(
        "pooliad/EightBall-v0",
        entry_point="client.learn.single:EightBallEnv",
        vector_entry_point="client.learn.vector:EightBallVectorEnv",
    )
