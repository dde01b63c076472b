"""Where things lie in the flat memory of a shot.

``w`` is float64 memory, ``k`` int64 memory, ``p`` the table's parameters. Per-ball quantities are rows of 16
lanes: quantity Q of ball i is ``w[Q + i]``. Coordinates are from the table's centre, so that mirror images and
half turns have the same bits. A ball's path since its own ``SINCE`` is r = X + V dt + H dt^2: H is half the
acceleration.
"""

LANES = 16

# --- float64, one row of lanes each -----------------------------------------------------------------
X, Y = 0, 16  # m
VX, VY, WX, WY, WZ = 32, 48, 64, 80, 96  # m/s, rad/s
HX, HY = 112, 128  # m/s^2
SINCE = 144  # s: time of the anchor
END = 160  # s: time of the ball's own next motion transition
NEXT = 176  # s: time of the ball's next event
CHANGE = 160  # the changes of a round of the contact rule lie this far behind VX ... WZ
CLOSING = 272  # m/s, one per touching pair: approach, then the normal change of velocity; 0 if it does not act
NORMAL_X, NORMAL_Y = CLOSING + 120, CLOSING + 240  # one per touching pair: unit vector from the lower ball
W_SIZE = NORMAL_Y + 120

# --- int64, one row of lanes each --------------------------------------------------------------------
MOTION = 0  # motion state, see below
KIND = 16  # kind of the next event
PARTNER = 32  # ball, cushion or pocket of the next event
FROZEN = 48  # for a ball in FROZEN_BALLS: the cushion
LINKS = 64  # scratch of the contact rule: active pairs at each ball

# --- int64 scalars -----------------------------------------------------------------------------------
N_EVENTS = 80
TRACE_ROWS = 81  # capacity of the trace
CONTACT_SEEN = 82  # whether the cue ball has struck a ball
CROSSED = 83  # whether the cue ball has crossed the head string
STRETCH = 84  # event that opened the cue ball's present stretch
CUSHION_SEEN, CUSHION_AFTER_SEEN = 85, 86  # bit sets of balls
N_PAIRS = 87  # touching pairs of the cluster
FROZEN_BALLS = 92  # bit set of the balls that have touched a cushion since the start without leaving it
LOOKS, PAIRS_LEFT, SOLVES, CUSHION_LOOKS = 88, 89, 90, 91  # counters of work
PAIRS = 96  # touching pairs of a cluster: first ball * 16 + second ball
K_SIZE = PAIRS + 120

# --- motion states (physics.events.Motion) -----------------------------------------------------------
STATIONARY, SPINNING, SLIDING, ROLLING, POCKETED, ABSENT = 0, 1, 2, 3, 4, 5

# --- kinds of a ball's next event --------------------------------------------------------------------
NOTHING, MEET_BALL, MEET_CUSHION, MEET_POCKET, TRANSITION, LOOK_AGAIN = 0, 1, 2, 3, 4, 5

# --- kinds in the trace: places in physics.events.KINDS ------------------------------------------------
CUE_STRIKE, BALL_COLLISION, RAIL_COLLISION, POCKET_COLLISION = 0, 1, 2, 3
SLIDING_ROLLING, SLIDING_SPINNING, SLIDING_STATIONARY = 4, 5, 6
ROLLING_SPINNING, ROLLING_STATIONARY, SPINNING_STATIONARY, CONTACT = 7, 8, 9, 10

# --- a row of the trace ------------------------------------------------------------------------------
T_TIME, T_KIND, T_BALL, T_OTHER, T_FIRST, T_SECOND = 0, 1, 2, 3, 4, 12
TRACE_WIDTH = 20
STATE_WIDTH = 8  # x y vx vy wx wy wz motion

# --- facts: places in FACTS_DTYPE, as int32 and as float64 ------------------------------------------------
F_STATUS, F_EVENTS, F_CROSSED, F_CROSSED_BEFORE = 0, 1, 2, 3
F_FIRST, F_CUSHION, F_CUSHION_AFTER = 4, 20, 36
F_POCKETED, F_POCKET, F_OFF_TABLE = 52, 68, 84
F_FROZEN_CUSHION, F_FROZEN_CUE = 100, 116
F_INTEGERS = 132
F_DURATION, F_CUE_X, F_CUE_Y = 66, 67, 68

# --- parameters of the table -------------------------------------------------------------------------
P_HALF_X, P_HALF_Y = 0, 1  # m: half width and half length, nose to nose
P_LINE_X, P_LINE_Y = 2, 3  # m: cushion lines of the ball's centre, moved inward by R
P_CORNER = 4  # m: |x| + |y| on the corner mouth lines
P_SIDE = 5  # m: half the side mouth
P_RADIUS = 6  # m
P_HEAD = 7  # m: head string, from the centre
P_SLIDE, P_ROLL, P_SPIN = 8, 9, 10  # m/s^2, m/s^2, rad/s^2: decelerations mu_s g, mu_r g, 5 mu_sp g / 2R
P_SPIN_SLIDING = 11  # rad/s^2: decay of w_z while sliding
P_MU_BALL, P_E_BALL = 12, 13
P_PARALLEL, P_PERPENDICULAR, P_KEEP_SPIN = 14, 15, 16
P_MASS_RATIO = 17  # ball mass / cue mass
P_HISTORICAL = 18  # 1.0 for the historical collision formulas
P_CUE_TEST, P_CUE_LENGTH, P_NOSE = 19, 20, 21
P_V_MAX, P_THETA_MAX = 22, 23
P_NO_SLIP = 24  # m/s
P_BRACKET, P_INERTIA = 25, 26  # strike: factor of the bracket, and I / (m R^2)
P_PER_RADIUS = 27  # 1/m
P_SLIDE_LASTS, P_ROLL_LASTS, P_SPIN_LASTS = 28, 29, 30  # s per m/s of slip, of speed; s per rad/s of spin
P_REST_TIME = 31  # s: see physics.parameters
P_EVENT_LIMIT = 32  # events after which a shot ends; not the table's, but the caller's
P_SIZE = 33
