"""What a game is about and what stays the same throughout it."""

from typing import Annotated

from pydantic import Field

from physics.table import Table
from protocol.memory import TABLE, made
from protocol.terms import BudgetView, NoiseView
from protocol.values import Digest, Identifier, Integer, Message, RulesName, TableValues


class GameTerms(Message):
    """What stays the same throughout a game.

    Attributes:
        game, match: ids. number: of this game in its match, from 0; games: how many the match has.
        players: names, by seat.
        table: every parameter of the table.
        noise: its level is null when the players are not told.
        budget: of simulated shots; null when any number may be simulated.
        dry_visits_limit: visits in a row without a ball pocketed, after which the rack is replayed (R49).
        replays_limit: replays of a rack, after which the next stalemate draws the game.
        strokes_limit: strokes, after which the game is drawn.
        commitment: to the secrets of the match and its terms (docs/protocol.md, Commitment).
    """

    game: Identifier
    match: Identifier
    number: Integer
    games: Integer
    players: tuple[str, str]
    rules: RulesName
    table: TableValues
    noise: NoiseView
    budget: BudgetView | None = None
    dry_visits_limit: Integer
    replays_limit: Integer
    strokes_limit: Integer
    commitment: Annotated[Digest, Field(examples=["0" * 64])]

    def table_model(self) -> Table:
        """The table, as the physics takes it."""
        return made(self, TABLE, self.table, Table.from_dict)
