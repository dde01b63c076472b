"""The ids of the rules, each with its sentence: what a ruling cites."""

from enum import StrEnum
from types import MappingProxyType
from typing import Final, Self


class RuleId(StrEnum):
    """A rule of World Standardized 8-ball as `docs/rules.md` numbers them. A member equals its id, e.g. ``"R32"``.

    Attributes:
        sentence: what the rule says.
    """

    sentence: str

    def __new__(cls, number: str, sentence: str) -> Self:
        """Make a member from its id and its sentence."""
        rule = str.__new__(cls, number)
        rule._value_ = number
        rule.sentence = sentence
        return rule

    R1 = "R1", "The apex ball of the rack lies on the foot spot."
    R2 = "R2", "The 8 lies in the centre of the rack's third row."
    R3 = "R3", "The rack's two back corners hold one solid and one stripe."
    R4 = "R4", "The other balls lie at random, drawn from the rack's seed."
    R5 = "R5", "Racked balls are separated by the table's rack gap and never overlap."
    R6 = "R6", "Behind the head string is meant strictly: on the string is not behind it."
    R7 = "R7", "The break is played with the cue ball in hand behind the head string."
    R8 = "R8", "The break is not called; any ball may be struck first, but one must be."
    R9 = "R9", "A legal break pockets an object ball or drives four different object balls to a cushion."
    R10 = "R10", "After a legal break that pockets a ball without a foul the breaker goes on."
    R11 = "R11", "After a legal break that pockets nothing the turn passes."
    R12 = (
        "R12",
        (
            "After an illegal break the opponent accepts the table as it lies, or has the balls racked again, "
            "to break himself or to see the breaker break again."
        ),
    )
    R12a = "R12a", "After an illegal break with a foul the opponent may re-rack or take what the foul gives."
    R13 = "R13", "With the 8 pocketed on the break the breaker has it spotted and goes on, or breaks again."
    R14 = (
        "R14",
        (
            "With the 8 and the cue ball pocketed on the break the opponent has the 8 spotted and takes ball "
            "in hand behind the head string, or breaks himself; after another foul the 8 is spotted."
        ),
    )
    R15 = "R15", "A scratch on a legal break gives the opponent ball in hand behind the head string."
    R16 = (
        "R16",
        (
            "An object ball off the table on the break is a foul; the opponent accepts the position or takes "
            "ball in hand behind the head string."
        ),
    )
    R17 = "R17", "Any other foul on the break gives the opponent the same choice."
    R18 = "R18", "The table is open after every break."
    R19 = "R19", "Legally pocketing a called ball on an open table fixes the groups."
    R20 = "R20", "On an open table any ball but the 8 may be struck first."
    R21 = "R21", "Other balls pocketed on an open table do not decide the groups."
    R22 = "R22", "A foul leaves an open table open."
    R23 = "R23", "Every stroke but the break calls a ball the shooter may play and a pocket, or a safety."
    R24 = "R24", "Kisses, banks and combinations do not matter to a call."
    R25 = "R25", "The called ball in another pocket is not made; it stays down and the turn passes."
    R26 = "R26", "After a safety the turn passes whatever was pocketed."
    R27 = "R27", "The 8 may be called only when the shooter's group was cleared before the stroke."
    R28 = "R28", "The shooter goes on only by legally pocketing the called ball in the called pocket."
    R29 = "R29", "Other balls pocketed stay down, the opponent's included."
    R30 = "R30", "Only the 8 is ever spotted, and only from the break."
    R31 = "R31", "A ball is spotted on the foot spot, or as near to it as possible on the long string, behind it first."
    R32 = "R32", "Foul: the cue ball is pocketed or leaves the table."
    R33 = "R33", "Foul: the ball struck first is not one the shooter may strike first."
    R34 = "R34", "Foul: no ball is struck."
    R35 = "R35", "Foul: no ball is pocketed, and none is driven to a cushion after contact."
    R36 = "R36", "Foul: an object ball leaves the table."
    R37 = "R37", "A bad placement of the cue ball is refused before the stroke."
    R38 = "R38", "Foul: from the kitchen, the cue ball has to cross the head string or reach a ball beyond it."
    R39 = "R39", "Foul: a miscue, the stroke made impossible by noise. Impossible as intended, it is refused."
    R40 = "R40", "A cue ball in hand is put inside the table, clear of every ball."
    R41 = "R41", "One penalty a stroke: every foul is reported, the worst applies."
    R42 = "R42", "Loss: the 8 pocketed on a stroke with a foul."
    R43 = (
        "R43",
        "Loss: the 8 pocketed before the shooter's group was cleared, on the clearing stroke or an open table as well.",
    )
    R44 = "R44", "Loss: the 8 in a pocket that was not called, or on a safety."
    R45 = "R45", "Loss: the 8 off the table."
    R46 = "R46", "Win: the 8 legally in the called pocket, the group cleared before."
    R47 = "R47", "A foul while on the 8, which stays up, gives ball in hand like any other."
    R48 = "R48", "Concession, time-out, forfeit and the like end the game, each with its own reason."
    R49 = "R49", "A game that does not get on is replayed by its first breaker, and drawn in the end."
    R50 = "R50", "The match's seed decides who breaks first; then the break alternates."
    R51 = "R51", "What falls before every ball rests belongs to the stroke."


RULES: Final = MappingProxyType({rule.value: rule.sentence for rule in RuleId})
"""Rule id to sentence."""


def plain_id(rule: str) -> str:
    """A rule's id as plain text: a member of `RuleId` is a special kind of text, which encoders take long over."""
    return str.__str__(rule)
