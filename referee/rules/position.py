"""Games that begin in the middle: the positions a game may be given."""

from dataclasses import replace

from physics.constants import N_BALLS
from physics.errors import InvalidState
from physics.table import Table
from referee.errors import InvalidGame
from referee.game import EIGHT, CueBallArea, Decision, Game, Phase, RuleId
from referee.rules.breaks import OFFERED
from referee.rules.stroke_facts import CUE_BALL

STARTS = (Phase.BREAK, Phase.PLAY, Phase.DECISION)


def begin_from(table: Table, game: Game) -> Game:
    """A new game that stands as `game` does: every counter at zero, the decisions those of its choice.

    Raises:
        InvalidGame: nothing that could be played on from, naming the field.
    """
    game = _well_formed(game)
    if game.phase not in STARTS:
        raise InvalidGame("phase", game.phase.value, f"one of {', '.join(STARTS)}")
    _require_places(table, game)
    decisions = _decisions(game)
    _require_balls(game, decisions)
    _require_area(game)
    return replace(game, decisions=decisions, stroke=0, rack=0, visit_strokes=0, dry_visits=0, replays=0, outcome=None)


def _well_formed(game: Game) -> Game:
    """The same game, every field of its kind; a dataclass alone would take anything."""
    if not isinstance(game, Game):
        raise InvalidGame("game", game, "a referee.Game")
    try:
        return Game.from_dict(game.to_dict())
    except (AttributeError, TypeError) as error:
        raise InvalidGame("game", game, f"a referee.Game with fields of their kind: {error}") from None


def _require_places(table: Table, game: Game) -> None:
    try:
        game.state.valid_on(table)
    except InvalidState as error:
        raise InvalidGame(error.field.replace("positions[", "balls.").rstrip("]"), error.value, error.allowed) from None


def _decisions(game: Game) -> tuple[Decision, ...]:
    """The decisions open: what the choice offers, and R12a only what the cue ball's place leaves."""
    if game.phase is not Phase.DECISION:
        if game.choice is not None:
            raise InvalidGame("choice", game.choice, f"null in phase {game.phase.value}")
        return ()
    if game.choice is None or game.choice not in OFFERED:
        raise InvalidGame("choice", game.choice, f"the rule that grants a choice: one of {', '.join(OFFERED)}")
    offered = OFFERED[game.choice]
    scratched = CUE_BALL not in game.state.balls
    return tuple(each for each in offered if not (scratched and each is Decision.ACCEPT_TABLE))


def _require_balls(game: Game, decisions: tuple[Decision, ...]) -> None:
    """The 8 is on the table unless it is to be spotted, the cue ball unless it is in hand."""
    balls = game.state.balls
    eight_is_down = Decision.SPOT_EIGHT in decisions
    if (EIGHT in balls) is eight_is_down:
        where = "off the table: the choice is about spotting it" if eight_is_down else "on the table"
        raise InvalidGame("balls", list(balls), f"the 8 {where}")
    if game.phase is Phase.BREAK and len(balls) != N_BALLS:
        raise InvalidGame("balls", list(balls), "all sixteen before the break")
    if CUE_BALL not in balls and not _may_lack_cue_ball(game):
        raise InvalidGame("balls", list(balls), "the cue ball on the table, or in hand")
    if game.choice == RuleId.R14 and CUE_BALL in balls:
        raise InvalidGame("balls", list(balls), "the cue ball off the table: R14 is about a scratch")


def _may_lack_cue_ball(game: Game) -> bool:
    after_scratch = game.phase is Phase.DECISION and game.choice in (RuleId.R12a, RuleId.R14)
    return after_scratch or (game.phase is Phase.PLAY and game.cue_ball_in_hand is not None)


def _require_area(game: Game) -> None:
    """The cue ball is in the kitchen before a break, and nobody's while a choice is open; no groups either."""
    area = game.cue_ball_in_hand
    if game.phase is Phase.BREAK and area is not CueBallArea.KITCHEN:
        raise InvalidGame("cue_ball_in_hand", area, "kitchen before the break")
    if game.phase is Phase.DECISION and area is not None:
        raise InvalidGame("cue_ball_in_hand", area.value, "null while a choice is open")
    if game.phase is not Phase.PLAY and game.groups is not None:
        raise InvalidGame("groups", [group.value for group in game.groups], f"null in phase {game.phase.value}")
