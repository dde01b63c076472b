"""Whether an agent keeps the protocol: it is played through scripted situations on a real server, and watched."""

from client.compliance.check import Checker, Report
from client.compliance.faults import Finding, FindingName
from client.compliance.situations import SITUATIONS, Situation

__all__ = ["SITUATIONS", "Checker", "Finding", "FindingName", "Report", "Situation"]
