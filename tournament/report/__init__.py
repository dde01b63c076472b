"""Reports: one object of data, a page made from it, and tables for analysis."""

from tournament.report.data import FORMAT, event_report, server_report
from tournament.report.html import page
from tournament.report.moments import Moment, replay, turning_points
from tournament.report.tables import COLUMNS, csv_text, json_lines, read_json_lines

__all__ = [
    "COLUMNS",
    "FORMAT",
    "Moment",
    "csv_text",
    "event_report",
    "json_lines",
    "page",
    "read_json_lines",
    "replay",
    "server_report",
    "turning_points",
]
