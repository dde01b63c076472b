"""What is on the wire, defined once: pydantic models of requests, answers and problems, and problem codes."""

from protocol.agents import AgentList, AgentRequest, AgentToken, AgentView
from protocol.allowed import Allowed, Area
from protocol.answers import MinimalAnswer, ShotsPage, StrokeAnswer
from protocol.best_strokes import BestStroke, BestStrokes
from protocol.clocks import ChargeView, ClockLedger, ForfeitRequest, SeatLedger
from protocol.game_terms import GameTerms
from protocol.games import GameAnswer, GameSummary
from protocol.keys import KeyList, KeyView
from protocol.ladder import Ladder, RungView
from protocol.matches import (
    AcceptRequest,
    ClientSeedRequest,
    MatchList,
    MatchRequest,
    MatchStatus,
    MatchView,
    RackTerms,
    RackView,
)
from protocol.outcomes import (
    BallStateView,
    EventView,
    EvidenceView,
    OutcomeView,
    Pocketed,
    RulingView,
)
from protocol.physics import (
    BatchAnswer,
    BatchRequest,
    BatchRow,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
)
from protocol.positions import Position
from protocol.problems import PROBLEM_JSON, Fault, Problem, ProblemCode, shown
from protocol.shots import (
    CallRequest,
    DecisionRequest,
    ShotParameters,
    ShotRequest,
    SubmittedAction,
)
from protocol.standings import RatingView, SequentialTestView, StandingsView, StandingView, TournamentStatus
from protocol.streams import ManyEvent, StreamClocks, StreamConnections, StreamResult, of_many
from protocol.strokes import StrokeDetail, StrokeView
from protocol.tables import DescribeRequest, JawView, NoseView, PocketView, TableDescription, TableList
from protocol.terms import BudgetView, ClockTerms, ClockView, NoiseTerms, NoiseView
from protocol.tokens import InvitationRequest, Invitations, TokenList, TokenRequest, TokenSecret, TokenView
from protocol.tournaments import (
    DisqualifyRequest,
    EntriesPage,
    EntryView,
    NumberedEntry,
    TournamentGame,
    TournamentList,
    TournamentRequest,
    TournamentSummary,
    TournamentView,
    VoidRequest,
)
from protocol.turns import TURN_MESSAGE, GameOver, MatchOver, SeedWanted, Turn, TurnMessage
from protocol.view import View

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
    "BestStroke",
    "BestStrokes",
    "BudgetView",
    "CallRequest",
    "ChargeView",
    "ClientSeedRequest",
    "ClockLedger",
    "ClockTerms",
    "ClockView",
    "DecisionRequest",
    "DescribeRequest",
    "DisqualifyRequest",
    "EntriesPage",
    "EntryView",
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
    "JawView",
    "KeyList",
    "KeyView",
    "Ladder",
    "ManyEvent",
    "MatchList",
    "MatchOver",
    "MatchRequest",
    "MatchStatus",
    "MatchView",
    "MinElevationAnswer",
    "MinElevationRequest",
    "MinimalAnswer",
    "NoiseTerms",
    "NoiseView",
    "NoseView",
    "NumberedEntry",
    "OutcomeView",
    "PocketView",
    "Pocketed",
    "Position",
    "Problem",
    "ProblemCode",
    "RackTerms",
    "RackView",
    "RatingView",
    "RulingView",
    "RungView",
    "SeatLedger",
    "SeedWanted",
    "SequentialTestView",
    "ShotParameters",
    "ShotRequest",
    "ShotsPage",
    "SimulateAnswer",
    "SimulateRequest",
    "StandingView",
    "StandingsView",
    "StreamClocks",
    "StreamConnections",
    "StreamResult",
    "StrokeAnswer",
    "StrokeDetail",
    "StrokeView",
    "SubmittedAction",
    "TableDescription",
    "TableList",
    "TokenList",
    "TokenRequest",
    "TokenSecret",
    "TokenView",
    "TournamentGame",
    "TournamentList",
    "TournamentRequest",
    "TournamentStatus",
    "TournamentSummary",
    "TournamentView",
    "Turn",
    "TurnMessage",
    "View",
    "VoidRequest",
    "of_many",
    "shown",
]
