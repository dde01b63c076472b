"""What is on the wire, defined once: pydantic models of requests, answers and problems, and problem codes."""

from referee.wire.agents import AgentList, AgentRequest, AgentToken, AgentView
from referee.wire.answers import ShotsPage, StrokeAnswer
from referee.wire.clocks import ChargeView, ClockLedger, ForfeitRequest, SeatLedger
from referee.wire.keys import KeyList, KeyView
from referee.wire.matches import (
    AcceptRequest,
    ClientSeedRequest,
    GameAnswer,
    GameSummary,
    MatchList,
    MatchRequest,
    MatchStatus,
    MatchView,
    RackTerms,
    RackView,
)
from referee.wire.outcomes import (
    BallStateView,
    EventView,
    EvidenceView,
    OutcomeView,
    Pocketed,
    RulingView,
)
from referee.wire.physics import (
    BatchAnswer,
    BatchRequest,
    BatchRow,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
)
from referee.wire.positions import Position
from referee.wire.problems import PROBLEM_JSON, Fault, Problem, ProblemCode, shown
from referee.wire.shots import (
    CallRequest,
    DecisionRequest,
    ShotParameters,
    ShotRequest,
    SubmittedAction,
)
from referee.wire.streams import ManyEvent, StreamClocks, StreamConnections, StreamResult, of_many
from referee.wire.strokes import StrokeDetail, StrokeView
from referee.wire.terms import BudgetView, ClockTerms, ClockView, NoiseTerms, NoiseView
from referee.wire.tokens import InvitationRequest, Invitations, TokenList, TokenRequest, TokenSecret, TokenView
from referee.wire.turns import TURN_MESSAGE, GameOver, MatchOver, SeedWanted, Turn, TurnMessage
from referee.wire.view import Allowed, Area, GameTerms, View

__all__ = [
    "PROBLEM_JSON",
    "TURN_MESSAGE",
    "AcceptRequest",
    "AgentList",
    "AgentRequest",
    "AgentToken",
    "AgentView",
    "Allowed",
    "Area",
    "BallStateView",
    "BatchAnswer",
    "BatchRequest",
    "BatchRow",
    "BudgetView",
    "CallRequest",
    "ChargeView",
    "ClientSeedRequest",
    "ClockLedger",
    "ClockTerms",
    "ClockView",
    "DecisionRequest",
    "EventView",
    "EvidenceView",
    "Fault",
    "ForfeitRequest",
    "GameAnswer",
    "GameOver",
    "GameSummary",
    "GameTerms",
    "InvitationRequest",
    "Invitations",
    "KeyList",
    "KeyView",
    "ManyEvent",
    "MatchList",
    "MatchOver",
    "MatchRequest",
    "MatchStatus",
    "MatchView",
    "MinElevationAnswer",
    "MinElevationRequest",
    "NoiseTerms",
    "NoiseView",
    "OutcomeView",
    "Pocketed",
    "Position",
    "Problem",
    "ProblemCode",
    "RackTerms",
    "RackView",
    "RulingView",
    "SeatLedger",
    "SeedWanted",
    "ShotParameters",
    "ShotRequest",
    "ShotsPage",
    "SimulateAnswer",
    "SimulateRequest",
    "StreamClocks",
    "StreamConnections",
    "StreamResult",
    "StrokeAnswer",
    "StrokeDetail",
    "StrokeView",
    "SubmittedAction",
    "TokenList",
    "TokenRequest",
    "TokenSecret",
    "TokenView",
    "Turn",
    "TurnMessage",
    "View",
    "of_many",
    "shown",
]
