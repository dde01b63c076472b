"""How a game stands in a row of int64, and what numbers stand for values of the referee. Imports no compiler."""

from typing import Final

from referee import CueBallArea, Decision, EndReason, Group, Phase
from referee.game import RuleId

(
    PHASE,  # place in PHASES
    TURN,
    BREAKER,
    GROUP,  # of seat 0: OPEN, or place in GROUPS
    AREA,  # of a cue ball in hand: place in AREAS
    CHOICE,  # that is open: place in CHOICES, or NO_CHOICE
    STROKE,
    RACK,
    VISIT_STROKES,
    DRY_VISITS,
    REPLAYS,
    WINNER,  # a seat, or NOBODY
    REASON,  # place in REASONS
    DECIDED_BY,  # place in ENDS
    WIDTH,
) = range(15)

PHASES: Final = (Phase.BREAK, Phase.PLAY, Phase.DECISION, Phase.RERACK, Phase.OVER)
BREAK, PLAY, DECISION, RERACK, OVER = range(5)
GROUPS: Final = (Group.SOLIDS, Group.STRIPES)
OPEN: Final = -1
AREAS: Final = (None, CueBallArea.KITCHEN, CueBallArea.ANYWHERE)
NOT_IN_HAND, KITCHEN, ANYWHERE = range(3)
CHOICES: Final = (RuleId.R12, RuleId.R12a, RuleId.R13, RuleId.R14, RuleId.R16, RuleId.R17)
R12, R12A, R13, R14, R16, R17 = range(6)
NO_CHOICE: Final = -1
DECISIONS: Final = tuple([each for each in Decision if each is not Decision.CONCEDE])
ACCEPT_TABLE, BALL_IN_HAND, SPOT_EIGHT, RERACK_AND_BREAK, OPPONENT_RERACKS = range(5)
REASONS: Final = tuple(EndReason)
EIGHT_MADE, EIGHT_WITH_FOUL, EIGHT_TOO_EARLY, EIGHT_NOT_AS_CALLED, EIGHT_OFF_TABLE, STALEMATE, STROKE_LIMIT = range(7)
ENDS: Final = (RuleId.R46, RuleId.R42, RuleId.R43, RuleId.R44, RuleId.R45, RuleId.R49, RuleId.R49)
"""The rule behind each of the first reasons."""
NOBODY: Final = -1

SAFETY: Final = -1
"""In place of a called ball."""

SPEED, DIRECTION, ELEVATION, SIDE, HEIGHT, PLACE_X, PLACE_Y, CHOOSING = range(8)
"""Numbers of an action, as `client.learn.codec` has them."""

PLAYED, UNSTRUCK, TO_REFEREE = range(3)
"""What became of an action: a stroke or a decision as it should be; no direction is free for the cue; one of the rare
ones that spot the 8, which the referee rules on himself."""

(
    T_WIDTH,
    T_LENGTH,
    T_HEAD,  # y of the head string
    T_RADIUS,
    T_SPEED,  # greatest, m/s
    T_ELEVATION,  # greatest, deg
    T_OFFSET,  # greatest tip offset to a side, mm
    T_CLEAR,  # least distance of a placed cue ball, m
    T_CLEARANCE,  # what a lattice's lowest place in the kitchen is above the head string, m
    T_MARGIN,  # deg, see codec.MARGIN
    T_SLACK,  # m, see PLACEMENT_TOLERANCE
    T_SIZE,
) = range(12)
"""Numbers of a table as the step needs them."""
