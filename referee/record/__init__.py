"""The record of a game: canonical JSON lines, and their verification with nothing else at hand."""

from referee.record.canonical import canonical
from referee.record.difference import Difference
from referee.record.engine import Engine, this_engine
from referee.record.lines import FORMAT, Header, end_entry, record_lines, stroke_entry
from referee.record.reading import InvalidRecord, Record, read_record
from referee.record.verification import Verdict, Verification, verify_record

__all__ = [
    "FORMAT",
    "Difference",
    "Engine",
    "Header",
    "InvalidRecord",
    "Record",
    "Verdict",
    "Verification",
    "canonical",
    "end_entry",
    "read_record",
    "record_lines",
    "stroke_entry",
    "this_engine",
    "verify_record",
]
