"""R6, R7, R37, R40: where the cue ball may be put."""

from math import dist, isfinite

from physics.constants import N_BALLS, PLACEMENT_TOLERANCE
from physics.table import Table
from referee.game import CueBallArea, Game, Refusal, RuleId
from referee.rules.stroke_facts import CUE_BALL

Point = tuple[float, float]


def behind_head_string(table: Table, y: float) -> bool:
    """R6: strictly; a ball on the string is not behind it."""
    return y > table.head_string


def in_area(table: Table, area: CueBallArea, y: float) -> bool:
    """R7: ball in hand behind the head string is bound to the kitchen, any other ball in hand to nothing."""
    return area is CueBallArea.ANYWHERE or behind_head_string(table, y)


def overlapped_balls(table: Table, game: Game, place: Point) -> tuple[int, ...]:
    """R40: the balls a cue ball at ``place`` would overlap; touching (within 1e-9 m) counts."""
    clear = 2.0 * table.ball_radius + PLACEMENT_TOLERANCE
    places = game.state.positions.tolist()  # an absent ball's distance is NaN, and no less than any
    return tuple([ball for ball in range(CUE_BALL + 1, N_BALLS) if dist(places[ball], place) <= clear])


def refuse_placement(table: Table, game: Game, place: Point | None) -> list[Refusal]:
    """R37: everything that is wrong with a placement; no refusal if it may be played from."""
    area = game.cue_ball_in_hand
    if area is None:
        return [] if place is None else [_refusal(place, "nothing: the cue ball is not in hand")]
    if place is None:
        return _refuse_lie(table, game, area)
    if not all(isfinite(coordinate) for coordinate in place):
        return [_refusal(place, "two finite numbers (x, y), metres")]
    refusals = []
    if not table.contains(*place):
        refusals.append(_refusal(place, "inside the cushion lines and outside the pocket mouths", RuleId.R40))
    if not in_area(table, area, place[1]):
        refusals.append(_refusal(place, f"behind the head string: y greater than {table.head_string}"))
    for ball in overlapped_balls(table, game, place):
        where = game.state.position(ball)
        refusals.append(_refusal(place, f"clear of ball {ball} at {where}: touching counts as overlap", RuleId.R40))
    return refusals


def _refuse_lie(table: Table, game: Game, area: CueBallArea) -> list[Refusal]:
    """A cue ball in hand may stay where it lies, if it lies somewhere it may be."""
    lie = game.state.position(CUE_BALL)
    if lie is None:
        return [_refusal(None, "two numbers (x, y): the cue ball is off the table and in hand")]
    if not in_area(table, area, lie[1]):
        return [_refusal(None, f"a place behind the head string: the cue ball lies at {lie}, in front of it")]
    return []


def _refusal(value: Point | None, allowed: str, rule: RuleId = RuleId.R37) -> Refusal:
    return Refusal(rule, "cue_ball", value, allowed)
