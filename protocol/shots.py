"""A stroke as it is asked for: the shot, the call and where the cue ball goes."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ConfigDict, Field, ValidatorFunctionWrapHandler, WrapValidator

from physics.errors import InvalidShot
from physics.pocket_names import POCKET_NUMBERS
from physics.shot import Shot
from physics.table import Table
from protocol.terms import SIMULATIONS_MAX
from protocol.values import Integer, Message, Number, ObjectBall, PocketNumber, Point, Request, trusted
from referee.game import Action, Call, Decision


class ShotParameters(Request):
    """The five parameters of a shot in Olympiad units. All of them are required.

    Any finite numbers can be written; those beyond its table's ranges are refused where the table is known.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"v": 3.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 4.0}]}
    )

    v: Annotated[Number, Field(description="Cue speed, m/s, from 0 to the table's `v_max`.")]
    phi: Annotated[Number, Field(description="Azimuth, deg, counter-clockwise from +x.")]
    theta: Annotated[Number, Field(description="Elevation of the cue, deg, from 0 to the table's `theta_max`.")]
    a: Annotated[Number, Field(description="Tip offset to the side, mm; positive gives right english.")]
    b: Annotated[Number, Field(description="Tip offset in height, mm; positive gives follow.")]

    def to_shot(self) -> Shot:
        """The physics' own value."""
        return Shot(self.v, self.phi, self.theta, self.a, self.b)

    def refuse_beyond(self, table: Table, place: str) -> None:
        """Raise InvalidShot, its field beginning with ``place``, if ``v`` or ``theta`` is not in the table's range."""
        try:
            self.to_shot().refuse_beyond(table)
        except InvalidShot as beyond:
            raise InvalidShot(f"{place}.{beyond.field}", beyond.value, beyond.allowed) from None

    @classmethod
    def of(cls, shot: Shot) -> "ShotParameters":
        """The wire's form of a shot."""
        return trusted(cls, **shot.to_dict())


def _numbered_pocket(value: Any) -> Any:
    """The number of a pocket given by its name."""
    return POCKET_NUMBERS.get(value, value) if isinstance(value, str) else value


class CallRequest(Request):
    """The ball and the pocket called."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"ball": 3, "pocket": 0}]})

    ball: ObjectBall
    pocket: Annotated[
        PocketNumber,
        BeforeValidator(_numbered_pocket),
        Field(description="SW W NW NE E SE = 0..5; a request may give the name instead."),
    ]


def _one_kind_of_call(value: Any, handler: ValidatorFunctionWrapHandler) -> Any:
    """Validate an object as a ball and a pocket alone, so that its errors speak of nothing else."""
    return CallRequest.model_validate(value) if isinstance(value, Mapping) else handler(value)


Simulated = Annotated[
    Integer,
    Field(
        ge=0,
        le=SIMULATIONS_MAX,
        description="Shots simulated elsewhere since the last action, by honour.",
        exclude_if=lambda shots: shots == 0,
    ),
]

Called = Annotated[CallRequest | Literal["safety"] | None, WrapValidator(_one_kind_of_call)]


class ShotRequest(Request):
    """``POST /v1/games/{id}/shots``: one stroke.

    ``call`` is null on the break and otherwise a ball and a pocket, or ``"safety"``. ``cue_ball`` may be
    given when the shooter has ball in hand, and must be when the cue ball is not on the table.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "shot": {"v": 9.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 0.0},
                    "call": None,
                    "cue_ball": [0.558, 1.72],
                },
                {
                    "shot": {"v": 2.5, "phi": 212.5, "theta": 5.0, "a": 0.0, "b": 4.0},
                    "call": {"ball": 3, "pocket": 0},
                    "cue_ball": None,
                },
                {
                    "shot": {"v": 1.0, "phi": 90.0, "theta": 5.0, "a": 0.0, "b": 0.0},
                    "call": "safety",
                    "cue_ball": None,
                },
            ]
        }
    )

    shot: ShotParameters
    call: Called = None
    cue_ball: Annotated[Point | None, Field(description="Where the cue ball is placed, m.")] = None
    simulated: Simulated = 0

    def to_action(self) -> Action:
        """The referee's own value."""
        return Action(shot=self.shot.to_shot(), call=_to_call(self.call), cue_ball=self.cue_ball)

    @classmethod
    def of(cls, action: Action, simulated: int = 0) -> "ShotRequest":
        """The request that asks for this action; it must hold a shot."""
        if action.shot is None:
            raise ValueError(f"action.shot = None: a decision is no shot: {action!r}")
        call = _from_call(action.call)
        shot = ShotParameters.of(action.shot)
        return cls(shot=shot, call=call, cue_ball=action.cue_ball, simulated=simulated)


class DecisionRequest(Request):
    """``POST /v1/games/{id}/decisions``: one of the choices the view allows."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"decision": "accept_table"}]})

    decision: Decision
    simulated: Simulated = 0

    def to_action(self) -> Action:
        """The referee's own value."""
        return Action(decision=self.decision)


class SubmittedAction(Message):
    """What a player asked for, as answers and histories show it: a shot or a decision."""

    shot: ShotParameters | None = None
    call: Called = None
    cue_ball: Point | None = None
    decision: Decision | None = None

    @classmethod
    def of(cls, action: Action) -> "SubmittedAction":
        """The wire's form of an action."""
        return trusted(
            cls,
            shot=None if action.shot is None else ShotParameters.of(action.shot),
            call=_from_call(action.call),
            cue_ball=action.cue_ball,
            decision=action.decision,
        )

    def to_action(self) -> Action:
        """The referee's own value."""
        return Action(
            shot=None if self.shot is None else self.shot.to_shot(),
            call=_to_call(self.call),
            cue_ball=self.cue_ball,
            decision=self.decision,
        )


def _to_call(called: Called) -> Call | Literal["safety"] | None:
    return Call(called.ball, called.pocket) if isinstance(called, CallRequest) else called


def _from_call(call: Call | str | None) -> Called:
    if isinstance(call, Call):
        return trusted(CallRequest, ball=call.ball, pocket=call.pocket)
    return None if call is None else "safety"
