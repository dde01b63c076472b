"""What the terms of an event choose among: formats, tie-breaks, who goes on, who stands first."""

from enum import StrEnum


class Format(StrEnum):
    """Who meets whom."""

    ROUND_ROBIN = "round_robin"
    """Everybody meets everybody once."""
    GAUNTLET = "gauntlet"
    """The challengers, the first entrants of the list, meet all others."""
    SWISS = "swiss"
    """A fixed number of rounds; who stands equal meets, nobody twice while that can be avoided."""
    KNOCKOUT = "knockout"
    """Who loses a meeting is out."""


class TieBreak(StrEnum):
    """What separates entrants with equal points, in the order of ``Spec.tie_breaks``."""

    DIRECT = "direct"
    """Points in the games of the tied among themselves."""
    SONNEBORN_BERGER = "sonneborn_berger"
    """Points of the opponents, each weighted by the share taken from them."""
    BUCHHOLZ = "buchholz"
    """Points of the opponents."""
    WINS = "wins"
    """Games won."""
    SEED = "seed"
    """The place in the list of entrants."""


class Drawn(StrEnum):
    """Who goes on when a meeting of a knockout is still drawn after the extra pairs."""

    SEED = "seed"
    """The one seeded higher."""
    LOT = "lot"
    """Drawn by lot, from the event's seed."""


class Seeding(StrEnum):
    """Where the order of the entrants comes from."""

    LISTED = "listed"
    """As listed: the strongest first."""
    DRAWN = "drawn"
    """Drawn by lot, from the event's seed."""


DEFAULT_TIE_BREAKS = {
    Format.ROUND_ROBIN: (TieBreak.DIRECT, TieBreak.SONNEBORN_BERGER, TieBreak.WINS),
    Format.GAUNTLET: (TieBreak.DIRECT, TieBreak.WINS),
    Format.SWISS: (TieBreak.BUCHHOLZ, TieBreak.SONNEBORN_BERGER, TieBreak.WINS),
    Format.KNOCKOUT: (),
}
