"""Whether an agent keeps the protocol: it is played through scripted situations on a real server, and watched."""

from client.compliance.check import Checker, Report
from client.compliance.faults import Fault, FaultName
from client.compliance.situations import SITUATIONS, Situation

__all__ = ["SITUATIONS", "Checker", "Fault", "FaultName", "Report", "Situation"]
