"""Where things lie in the flat memory of a shot. No number of a column, a kind or a state stands anywhere else.

Kernels say ``from physics.kernels import layout as at`` and ``load(s.w, at.VX + i)``: ``w`` is float64 memory, ``k``
int64 memory, ``p`` the table's parameters (``physics.kernels.workspace``). Per-ball quantities are rows of 16 lanes:
quantity Q of ball i is ``w[Q + i]``. Coordinates are from the table's centre, so that mirror images and half turns
have the same bits. A ball's path since its own ``SINCE`` is r = X + V dt + H dt^2: H is half the acceleration. Z counts
from where a centre rests on the cloth. What is vertical stays 0 on tables that do not fly.

Plain numbers: importing this module loads no compiler.
"""

LANES = 16
"""Balls, and lanes of a row."""

MOST_PAIRS = LANES * (LANES - 1) // 2

# --- float64, one row of lanes each -----------------------------------------------------------------
(
    X,  # m
    Y,
    VZ,  # m/s, rad/s
    VX,
    VY,
    WX,
    WY,
    WZ,
    HX,  # m/s^2
    HY,
    SINCE,  # s: time of the anchor
    END,  # s: time of the ball's own next motion transition
    NEXT,  # s: time of the ball's next event
    VZ_CHANGE,  # of a round of the contact rule
    VX_CHANGE,
    VY_CHANGE,
    WX_CHANGE,
    WY_CHANGE,
    WZ_CHANGE,
    Z,  # m: height of the centre above where it rests on the cloth
    HZ,  # m/s^2
    PRESSED,  # s: a landing before this time is a ball pressed down by a cushion
    CLOSING,
) = range(0, 23 * LANES, LANES)
SPEEDS = (VX, VY, WX, WY, WZ)
CHANGE = VX_CHANGE - VX
"""How far the changes of a round of the contact rule lie behind what they change."""

# --- float64, one a touching pair --------------------------------------------------------------------
# CLOSING, m/s: approach, then the normal change of velocity; 0 if the pair does not act
NORMAL_X, NORMAL_Y = CLOSING + MOST_PAIRS, CLOSING + 2 * MOST_PAIRS  # unit vector from the ball of the lower number
NORMAL_Z = NORMAL_Y + MOST_PAIRS
W_SIZE = NORMAL_Z + MOST_PAIRS

# --- int64, one row of lanes each --------------------------------------------------------------------
(
    MOTION,  # motion state, see below
    KIND,  # kind of the next event
    PARTNER,  # ball, cushion or pocket of the next event
    FROZEN,  # for a ball in FROZEN_BALLS: the cushion
    LINKS,  # scratch of the contact rule: active pairs at each ball
    PARTINGS,  # how often step 3 of the contact rule has parted a flying ball
    SCALARS,
) = range(0, 7 * LANES, LANES)

# --- int64 scalars, all 0 when a shot starts -----------------------------------------------------------
(
    N_EVENTS,  # so far
    TRACE_ROWS,  # capacity of the trace
    ENDED,  # why the event loop stopped, see below
    CONTACT_SEEN,  # whether the cue ball has struck a ball
    CROSSED,  # whether the cue ball has crossed the head string
    STRETCH,  # event that opened the cue ball's present stretch
    CUSHION_SEEN,  # bit sets of balls
    CUSHION_AFTER_SEEN,
    FROZEN_BALLS,  # bit set of the balls that have touched a cushion since the start without leaving it
    FLYING_BALLS,  # bit sets of the balls in the air, of those out of play since the start, of those to be taken off
    GONE_BALLS,
    PERCHED_BALLS,
    N_PAIRS,  # touching pairs of the cluster
    LOOKS,  # counters of work
    PAIRS_LEFT,
    SOLVES,
    CUSHION_LOOKS,
    PAIRS,  # touching pairs of a cluster: first ball * 16 + second ball
) = range(SCALARS, SCALARS + 18)
N_COUNTERS = CUSHION_LOOKS - LOOKS + 1
K_SIZE = PAIRS + MOST_PAIRS

# --- motion states (physics.events.Motion) -----------------------------------------------------------
STATIONARY, SPINNING, SLIDING, ROLLING, POCKETED, ABSENT, FLYING, DRIVEN_OFF = range(8)

# --- kinds of a ball's next event; of simultaneous ones the lower comes first --------------------------
NOTHING, MEET_BALL, MEET_CUSHION, MEET_JAW, MEET_POCKET, MEET_TOP, LEAVE, TRANSITION, LOOK_AGAIN = range(9)

# --- kinds in the trace (physics.events.KINDS) ----------------------------------------------------------
CUE_STRIKE, BALL_COLLISION, RAIL_COLLISION, POCKET_COLLISION = range(4)
SLIDING_ROLLING, SLIDING_SPINNING, SLIDING_STATIONARY = 4, 5, 6
ROLLING_SPINNING, ROLLING_STATIONARY, SPINNING_STATIONARY, CONTACT = 7, 8, 9, 10
JAW_COLLISION, LANDING, RAIL_TOP, OFF_TABLE = 11, 12, 13, 14

# --- statuses (physics.status.Status) -------------------------------------------------------------------
AT_REST, CUE_OBSTRUCTED, TIP_OFF_BALL, OUT_OF_RANGE, NO_CUE_BALL, EVENT_LIMIT = range(6)

# --- why the event loop stopped: all but the first are EVENT_LIMIT to the outside ------------------------
NOTHING_TO_COME, OUT_OF_EVENTS, OUT_OF_STEPS, OUT_OF_ROUNDS = range(4)

# --- balls, cushions, pockets ----------------------------------------------------------------------------
CUE_BALL = 0
NOBODY = -1  # in place of a ball's number
WEST, EAST, SOUTH, NORTH = range(4)
NO_CUSHION = -1
FIRST_JAW = 4  # + the jaw's number 0..11: the cushions of a table with jaws go on
POCKET_SW, POCKET_W, POCKET_NW, POCKET_NE, POCKET_E, POCKET_SE = range(6)
ABSENT_FROM_START = -2  # in place of a pocket's number, for a ball that was not there; -1 for one that stayed

# --- what is in the cue's way: 0 to 15 a ball, NOBODY, or ------------------------------------------------
THROUGH_CUE_BALL = LANES  # the cue ball's own body
BEHIND_CUSHION = LANES + 1  # + the cushion's number

# --- a shot, in Olympiad units ---------------------------------------------------------------------------
S_V, S_PHI, S_THETA, S_A, S_B = range(5)  # m/s, deg, deg, mm, mm
SHOT_WIDTH = 5

# --- a ball's state: 16 of them are a snapshot, one or two stand in a row of the trace -------------------
A_X, A_Y, A_VX, A_VY, A_WX, A_WY, A_WZ, A_MOTION = range(8)
STATE_WIDTH = 8
A_Z, A_VZ = 8, 9  # of a table with jaws
REAL_STATE_WIDTH = 10

# --- a row of the trace ----------------------------------------------------------------------------------
T_TIME, T_KIND, T_BALL, T_OTHER, T_FIRST = range(5)
T_SECOND = T_FIRST + STATE_WIDTH  # of a ball collision alone
TRACE_WIDTH = T_SECOND + STATE_WIDTH
REAL_TRACE_WIDTH = T_FIRST + 2 * REAL_STATE_WIDTH

# --- facts: the fields of physics.facts.FACTS_DTYPE, int32 and then float64 --------------------------------
INTEGER_FACTS = {
    "status": 1,
    "n_events": 1,
    "crossed_head_string": 1,
    "crossed_before_contact": 1,
    "first_contact": LANES,
    "cushion": LANES,
    "cushion_after_contact": LANES,
    "pocketed": LANES,
    "pocket": LANES,
    "off_table": LANES,
    "frozen_to_cushion": LANES,
    "frozen_to_cue_ball": LANES,
    "miscue": 1,
}
FLOAT_FACTS = {"duration": 1, "first_contact_cue_ball": 2}
"""Name and how many numbers."""

F_STATUS, F_EVENTS, F_CROSSED, F_CROSSED_BEFORE = range(4)
F_FIRST, F_CUSHION, F_CUSHION_AFTER, F_POCKETED, F_POCKET, F_OFF_TABLE, F_FROZEN_CUSHION, F_FROZEN_CUE = range(
    4, 4 + 8 * LANES, LANES
)
F_MISCUE = F_FROZEN_CUE + LANES
F_INTEGERS = F_MISCUE + 1
F_DURATION, F_CUE_X, F_CUE_Y = range((F_INTEGERS + 1) // 2, (F_INTEGERS + 1) // 2 + 3)  # as float64
FACTS_WIDTH = 2 * (F_CUE_Y + 1)  # as int32

# --- parameters of the table -------------------------------------------------------------------------------
(
    P_HALF_X,  # m: half width and half length, nose to nose
    P_HALF_Y,
    P_LINE_X,  # m: cushion lines of the ball's centre, moved inward by R
    P_LINE_Y,
    P_CORNER,  # m: |x| + |y| on the corner mouth lines
    P_SIDE,  # m: half the side mouth
    P_RADIUS,  # m
    P_HEAD,  # m: head string, from the centre
    P_SLIDE,  # m/s^2, m/s^2, rad/s^2: decelerations mu_s g, mu_r g, 5 mu_sp g / 2R
    P_ROLL,
    P_SPIN,
    P_SPIN_SLIDING,  # rad/s^2: decay of w_z while sliding
    P_MU_BALL,
    P_E_BALL,
    P_PARALLEL,  # factors of a rail collision
    P_PERPENDICULAR,
    P_KEEP_SPIN,
    P_MASS_RATIO,  # ball mass / cue mass
    P_HISTORICAL,  # 1.0 for the historical collision formulas
    P_CUE_TEST,  # 1.0 if a blocked cue counts; m, m
    P_CUE_LENGTH,
    P_NOSE,
    P_V_MAX,  # m/s, deg
    P_THETA_MAX,
    P_NO_SLIP,  # m/s
    P_BRACKET,  # strike: factor of the bracket, and I / (m R^2)
    P_INERTIA,
    P_PER_RADIUS,  # 1/m
    P_SLIDE_LASTS,  # s per m/s of slip, of speed; s per rad/s of spin
    P_ROLL_LASTS,
    P_SPIN_LASTS,
    P_REST_TIME,  # s: see physics.parameters
    P_EVENT_LIMIT,  # events after which a shot ends: not the table's, but the caller's
    P_SIZE,
) = range(34)

# --- and of a table with jaws, behind them -------------------------------------------------------------------
(
    P_RHO,  # m: contact distance in plan
    P_NOSE_COSINE,  # of the normal's dip at the nose
    P_NOSE_SINE,
    P_CUSHION_LAW,  # see below
    P_E_CUSHION,
    P_MU_CUSHION,
    P_MU_SLIDE,
    P_BALL_LAW,  # see below
    P_END_RATIO,  # cue end mass / ball mass
    P_E_TIP,
    P_MU_TIP,
    P_FLIGHT,  # 1.0 if balls leave the cloth
    P_GRAVITY,  # m/s^2
    P_NOSE_RISE,  # m: how far the nose is above the centre of a ball on the cloth
    P_E_CLOTH,
    P_E_STRIKE,
    P_E_PRESSED,
    P_E_RAIL,
    P_MU_RAIL,
    P_CUSHION_WIDTH,  # m: from the nose line
    P_RAIL_WIDTH,
    P_CORNER_JAW,  # a mouth: see MOUTH_WIDTH
) = range(P_SIZE, P_SIZE + 22)
JAW_NOSE_END, JAW_HORN, JAW_START_S, JAW_START_D, JAW_NORMAL_S, JAW_NORMAL_D, JAW_LENGTH = range(7)
HOLE_U, HOLE_V, HOLE_RADIUS = range(7, 10)
MOUTH_WIDTH = 10
"""Numbers of a mouth in jaw coordinates (``physics.mouths``): nose end, horn radius, the facing's start, normal and
length, the hole's centre and radius."""
P_SIDE_JAW = P_CORNER_JAW + MOUTH_WIDTH
P_REAL_SIZE = P_SIDE_JAW + MOUTH_WIDTH

# --- laws by name (physics.real_table) -------------------------------------------------------------------------
FACTORS, HAN, MATHAVAN = range(3)
CONSISTENT, FASTFIZ, ALCIATORE = range(3)
