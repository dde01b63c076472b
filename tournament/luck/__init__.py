"""Luck: how much of a result the execution noise made."""

from tournament.luck.game import GameLuck, game_luck
from tournament.luck.stroke import DRAWS, StrokeLuck, stroke_luck
from tournament.luck.value import FEATURES, VALUE, ValueModel

__all__ = ["DRAWS", "FEATURES", "VALUE", "GameLuck", "StrokeLuck", "ValueModel", "game_luck", "stroke_luck"]
