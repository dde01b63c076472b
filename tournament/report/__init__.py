"""Reports: one object of data, a page made from it, and tables for analysis."""

from tournament.report.data import FORMAT, event_report, server_report
from tournament.report.html import page
from tournament.report.tables import COLUMNS, csv_text, json_lines, read_json_lines

__all__ = ["COLUMNS", "FORMAT", "csv_text", "event_report", "json_lines", "page", "read_json_lines", "server_report"]
