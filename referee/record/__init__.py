"""The record of a game: chained and signed JSON lines, the commitment they rest on, and their verification.

Nothing else is needed at hand; a signature needs the public key.
"""

from referee.record.canonical import canonical
from referee.record.chain import GENESIS, Chain, ChainFault, line_digest
from referee.record.commitment import FORMAT, MatchTerms
from referee.record.difference import Difference
from referee.record.engine import Engine, this_engine
from referee.record.lines import Header, end_entry, record_lines, stroke_entry
from referee.record.reading import InvalidRecord, Record, read_record
from referee.record.signing import Seal, SealState, signed_seal, unsigned_seal
from referee.record.signing_keys import PublicKey, SigningKey
from referee.record.verdict import RecordVerdict, Verification
from referee.record.verification import verify_record

__all__ = [
    "FORMAT",
    "GENESIS",
    "Chain",
    "ChainFault",
    "Difference",
    "Engine",
    "Header",
    "InvalidRecord",
    "MatchTerms",
    "PublicKey",
    "Record",
    "RecordVerdict",
    "Seal",
    "SealState",
    "SigningKey",
    "Verification",
    "canonical",
    "end_entry",
    "line_digest",
    "read_record",
    "record_lines",
    "signed_seal",
    "stroke_entry",
    "this_engine",
    "unsigned_seal",
    "verify_record",
]
