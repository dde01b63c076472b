"""The game as an environment for learning, over the referee and the stroke that servers play with.

`EightBallAEC` is a PettingZoo environment of both players, `EightBallEnv` a Gymnasium one against an opponent,
`EightBallVectorEnv` many of those at once. They need the `learn` extra; `observe` and `act`, which they share, do not.

Importing this package registers both with Gymnasium: `gymnasium.make("client.learn:pooliad/EightBall-v0")`, and
`gymnasium.make_vec` of the same name.
"""

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from client.learn.aec import EightBallAEC
    from client.learn.codec import ACTION_SIZE, OBSERVATION_SIZE, act, observe
    from client.learn.single import EightBallEnv
    from client.learn.vector import EightBallVectorEnv

__all__ = [
    "ACTION_SIZE",
    "OBSERVATION_SIZE",
    "EightBallAEC",
    "EightBallEnv",
    "EightBallVectorEnv",
    "act",
    "observe",
]

_HOMES = {
    "ACTION_SIZE": "codec",
    "OBSERVATION_SIZE": "codec",
    "act": "codec",
    "observe": "codec",
    "EightBallAEC": "aec",
    "EightBallEnv": "single",
    "EightBallVectorEnv": "vector",
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
