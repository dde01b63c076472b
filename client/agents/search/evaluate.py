"""How good strokes are: simulated as meant, or many times under the game's noise, ruled on, and valued.

Thinking is a generator: it yields a `Question` and is sent the answer. `answered` runs it for one turn;
`benchmarks/lockstep.py` runs hundreds of games together.
"""

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from client.agents.search.budget import Budget, TimeUp
from client.agents.search.draws import independent_normals, spread_normals
from client.agents.search.odds import safety_odds
from client.agents.search.options import USUAL, Options
from client.agents.search.shots import THETA, Floats, Groups, Integers, Shots, V
from client.agents.search.value import Values
from physics import Batch, Table
from physics.shot import FIELDS
from referee.play.noise import NoiseModel
from referee.rules.batch_rulings import SAFETY_CALL, read_verdicts

AT_ONCE = 1000
"""Strokes of a question to a clock: it is looked at between them."""

Simulate = Callable[[Table, Floats, Floats], Batch]
"""As `client.Simulator.simulate_batch`: table, positions (n, 16, 2), strokes (n, 5)."""


@dataclass(frozen=True, slots=True, eq=False)
class Question:
    """What comes of strokes?

    Attributes:
        before: (n, 16, 2) m, the tables, the cue ball placed. strokes: (n, 5), noise included.
        group, ball, pocket: (n,), the shooter's group and the calls.
        kitchen: whether the cue ball is in hand behind the head string (R38).
        judged: whether the worth of each is asked for, or what it did.
    """

    before: Floats
    strokes: Floats
    group: Groups
    ball: Integers
    pocket: Integers
    kitchen: bool
    judged: bool

    def __len__(self) -> int:
        return len(self.strokes)

    def part(self, first: int, last: int) -> "Question":
        """The same about some of the strokes."""
        rows = slice(first, last)
        calls = self.group[rows], self.ball[rows], self.pocket[rows]
        return Question(self.before[rows], self.strokes[rows], *calls, self.kitchen, self.judged)


Answer = Any
"""The worth of each stroke, (n,), where it was asked for; what the strokes did otherwise, a `physics.Batch`."""
Result = TypeVar("Result")
Thinking = Generator[Question, Answer, Result]
"""A train of thought that ends with a result."""


class Responder:
    """Answers questions: plays the strokes, rules on them and values what they leave.

    Args:
        table: the game's. values: of its positions. simulate: the physics, counted.
    """

    def __init__(self, table: Table, values: Values, simulate: Simulate) -> None:
        self._table, self._values, self._simulate = table, values, simulate

    def answer(self, question: Question) -> Answer:
        """What the strokes did, or their worth (n,)."""
        batch = self._simulate(self._table, question.before, question.strokes)
        return self._worth(question, batch, question.kitchen) if question.judged else batch

    def answers(self, questions: Sequence[Question]) -> list[Answer]:
        """The answers to many questions, simulated and valued together."""
        ends = np.cumsum([len(question) for question in questions]).tolist()
        parts = [slice(end - len(question), end) for question, end in zip(questions, ends, strict=True)]
        whole = joined(questions)
        batch = self._simulate(self._table, whole.before, whole.strokes)
        worth = np.empty(0)
        if whole.judged:
            kitchen = np.concatenate([np.full(len(question), question.kitchen) for question in questions])
            worth = self._worth(whole, batch, kitchen)
        return [
            worth[rows] if question.judged else part_of(batch, rows)
            for question, rows in zip(questions, parts, strict=True)
        ]

    def _worth(self, question: Question, batch: Batch, kitchen: bool | NDArray[np.bool_]) -> Floats:
        """What each stroke leaves its player, by referee and race."""
        calls = (question.group, question.ball, question.pocket)
        verdicts = read_verdicts(self._table, question.before, *calls, batch, kitchen)
        return self._values.after(question.before, batch.positions, verdicts)


def joined(questions: Sequence[Question]) -> Question:
    """All strokes of many questions; judged if any is."""
    return Question(
        before=np.concatenate([question.before for question in questions]),
        strokes=np.concatenate([question.strokes for question in questions]),
        group=np.concatenate([question.group for question in questions]),
        ball=np.concatenate([question.ball for question in questions]),
        pocket=np.concatenate([question.pocket for question in questions]),
        kitchen=False,
        judged=any(question.judged for question in questions),
    )


def part_of(batch: Batch, rows: slice) -> Batch:
    """Some rows of a batch."""
    return Batch(batch.positions[rows], batch.pocket[rows], batch.status[rows], batch.facts[rows])


def answered(thinking: Thinking[Result], responder: Responder) -> Result:
    """Run a train of thought to its end; raises what the physics raises, into it first."""
    try:
        question = next(thinking)
        while True:
            try:
                answer = responder.answer(question)
            except Exception as error:
                question = thinking.throw(error)
            else:
                question = thinking.send(answer)
    except StopIteration as end:
        result: Result = end.value
        return result


class Evaluator:
    """Asks what comes of strokes.

    Args:
        table: the game's. values: of positions. noise: a level, or the noise. chance: where the noise comes from.
        budget: of the stroke. kitchen: whether the cue ball is in hand behind the head string (R38).
        options: how draws of the noise are spread, and what safeties are reckoned to be worth.

    Its methods raise `TimeUp` when the budget's seconds have passed.
    """

    def __init__(
        self,
        table: Table,
        values: Values,
        noise: float | NoiseModel,
        chance: np.random.Generator,
        budget: Budget,
        kitchen: bool,
        options: Options = USUAL,
    ) -> None:
        self.table, self.values, self.budget = table, values, budget
        model = NoiseModel.of(noise)
        self.noise, self._spread = model.level, model.level * model.sigmas.row()
        self._chance, self._kitchen = chance, kitchen
        self._normals = spread_normals if options.even_draws else independent_normals
        odds = safety_odds(self.noise, values.sight.has_jaws)
        self._safety = odds if options.safety_odds and odds.shift else None

    def simulated(self, shots: Shots) -> Thinking[Batch]:
        """What the strokes do as they are meant, without noise."""
        batches = yield from self._asked(shots, 1, shots.strokes, judged=False)
        if len(batches) == 1:
            only: Batch = batches[0]
            return only
        arrays = [[getattr(batch, name) for batch in batches] for name in ("positions", "pocket", "status", "facts")]
        return Batch(*(np.concatenate(parts) for parts in arrays))

    def as_meant(self, shots: Shots) -> Thinking[Floats]:
        """What the strokes are worth without noise, (k,)."""
        worths = yield from self._asked(shots, 1, shots.strokes, judged=True)
        return self._borne_out(shots, np.concatenate(worths)[:, None])[:, 0]

    def noisy(self, shots: Shots, copies: int) -> Thinking[Floats]:
        """What each copy of each stroke is worth under noise, (k, copies), or (k, 1) where there is none.

        All strokes are played under the same draws: their differences are not the draws'.
        """
        copies = copies if self.noise > 0.0 else 1
        draws = self._spread * self._normals(self._chance, copies)
        strokes = (shots.strokes[:, None, :] + draws[None, :, :]).reshape(-1, len(FIELDS))
        strokes[:, V] = np.clip(strokes[:, V], 0.0, self.table.v_max)
        strokes[:, THETA] = np.clip(strokes[:, THETA], 0.0, self.table.theta_max)
        worths = yield from self._asked(shots, copies, strokes, judged=True)
        return self._borne_out(shots, np.concatenate(worths).reshape(len(shots), copies))

    def _borne_out(self, shots: Shots, worths: Floats) -> Floats:
        """The worths (k, copies), those of safeties as games bear them out."""
        if self._safety is None:
            return worths
        return np.where((shots.ball == SAFETY_CALL)[:, None], self._safety.of(worths), worths)

    def _asked(self, shots: Shots, copies: int, strokes: Floats, *, judged: bool) -> Thinking[list[Answer]]:
        """The answers about strokes, `copies` of each, in parts between which a clock is looked at."""

        rows = np.repeat(np.arange(len(shots)), copies)
        calls = shots.ball[rows], shots.pocket[rows]
        whole = Question(shots.before()[rows], strokes, shots.group()[rows], *calls, self._kitchen, judged)
        found: list[Answer] = []
        most = AT_ONCE if self.budget.is_timed else max(1, len(whole))
        for first in range(0, len(whole), most):
            question = whole.part(first, first + most)
            self.budget.charge(len(question))
            found.append((yield question))
            if self.budget.is_timed and self.budget.spent >= 1.0:
                raise TimeUp
        return found
