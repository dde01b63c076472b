"""What verification found: a verdict, and everything that speaks for it."""

from dataclasses import dataclass
from enum import StrEnum

from referee.game import Outcome
from referee.play import GrantedBudget
from referee.record.chain import ChainFault
from referee.record.difference import Difference
from referee.record.engine import Engine, this_engine
from referee.record.signing import Seal


class RecordVerdict(StrEnum):
    """What verification found."""

    VERIFIED = "verified"
    """Everything follows from the secrets and the actions, to the last bit; chain and signature are whole."""
    SAME_GAME = "same_game"
    """Another engine made it, and this one gives the same game, to the last bit; chain and signature are whole."""
    DIFFERENT = "different"
    """Something does not follow; the difference says what."""
    BROKEN_CHAIN = "broken_chain"
    """A line does not continue the one before it; the chain's fault says which."""
    BAD_SIGNATURE = "bad_signature"
    """The seal is not what the given keys sign; its problem says why."""
    OTHER_ENGINE = "other_engine"
    """Another engine made the record, and this one gives another game or cannot read it: that engine is needed."""
    MALFORMED = "malformed"
    """This is not a whole, well-formed record."""


@dataclass(frozen=True, slots=True)
class Verification:
    """The answer of ``verify_record``.

    Attributes:
        verdict: the gravest finding; chain and seal are told beside any other.
        strokes: how many strokes and decisions were verified.
        outcome: of the game, when everything follows.
        budget: of simulated shots that the terms grant, None without one. simulated: how many were, by seat: as the
            server counted and the players declared.
        difference: the first one.
        needs: the engine that made the record, when it is another than the one that is running.
        chain: where the chain is broken; None if it is whole.
        seal: what is known of the signature; None for a malformed record.
        problem: why the record is malformed, or cannot be read by this engine, in words.
    """

    verdict: RecordVerdict
    strokes: int = 0
    outcome: Outcome | None = None
    budget: GrantedBudget | None = None
    simulated: tuple[int, int] | None = None
    difference: Difference | None = None
    needs: Engine | None = None
    chain: ChainFault | None = None
    seal: Seal | None = None
    problem: str | None = None

    @property
    def ok(self) -> bool:
        """Whether all of the record follows, with the engine that made it or with this one."""
        return self.verdict in (RecordVerdict.VERIFIED, RecordVerdict.SAME_GAME)

    def __str__(self) -> str:
        parts = (self._finding(), self._counted(), self.chain and f"broken chain: {self.chain}", self.seal)
        return "; ".join(str(part) for part in parts if part is not None)

    def _counted(self) -> str | None:
        """The budget of simulated shots and what was counted against it."""
        if self.budget is None or self.simulated is None:
            return None
        first, second = self.simulated
        who = "by honour" if self.budget.counted == "by_honour" else "by the driver"
        return f"{first} and {second} of {self.budget.simulations} simulated shots each, counted {who}"

    def _finding(self) -> str | None:
        """What the game played again has shown."""
        if self.verdict is RecordVerdict.MALFORMED:
            return f"malformed: {self.problem}"
        if self.needs is not None:
            return f"made by {self.needs}; this engine, {this_engine()}, {self._of_another()}"
        if self.difference is not None:
            return f"different after {self.strokes} good lines: {self.difference}"
        words = f"{self.strokes} strokes and decisions follow from the secrets, bit for bit"
        return f"verified: {words}" if self.ok else f"not verified, although {words}"

    def _of_another(self) -> str:
        """What this engine made of another's record."""
        if self.problem is not None:
            return f"cannot read it: {self.problem}"
        if self.difference is not None:
            return f"differs at {self.difference}"
        return f"gives the same game, bit for bit ({self.strokes} strokes and decisions)"
