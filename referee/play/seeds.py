"""Secrets of a match: one match seed, from it each game's noise seed and rack seeds, and their commitments.

Derivations are HMAC-SHA-256 with a label, so no seed tells anything about another: a revealed noise seed
gives away neither the match seed nor the noise of the next game, and a game's racks say nothing about its
noise. The labels are part of the record format (docs/protocol.md).
"""

import hashlib
import hmac
import secrets
from dataclasses import dataclass, field
from typing import Self

from referee.rules import breaker

SEED_BYTES = 32
"""256 bits: out of reach of any search."""


@dataclass(frozen=True, slots=True)
class GameSeeds:
    """The two secrets of one game. Neither shows in ``repr``, so neither slips into a log.

    Attributes:
        noise: 32 bytes; with a stroke's index it fixes that stroke's noise.
        racks: 32 bytes; with a rack's index it fixes that rack. Two games may share it and play equal racks.
    """

    noise: bytes = field(repr=False)
    racks: bytes = field(repr=False)

    def __post_init__(self) -> None:
        _check_seed("noise", self.noise)
        _check_seed("racks", self.racks)

    @property
    def commitment(self) -> str:
        """SHA-256 of the noise seed, hex: published before the break."""
        return commitment(self.noise)

    def rack(self, index: int) -> bytes:
        """The seed of the game's ``index``-th rack, for ``physics.rack``."""
        return _derive(self.racks, f"pooliad/1 rack {index}")


@dataclass(frozen=True, slots=True)
class MatchSeed:
    """The secret from which everything random in a match comes.

    Attributes:
        secret: 32 bytes.
    """

    secret: bytes = field(repr=False)

    def __post_init__(self) -> None:
        _check_seed("secret", self.secret)

    @classmethod
    def fresh(cls) -> Self:
        """A new secret from the operating system."""
        return cls(secrets.token_bytes(SEED_BYTES))

    @classmethod
    def of(cls, seed: int) -> Self:
        """A repeatable one from an integer >= 0: for demonstrations and tests, where nobody guesses."""
        if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
            raise ValueError(f"seed = {seed!r}: must be an integer >= 0")
        return cls(hashlib.sha256(f"pooliad/1 match {seed}".encode("ascii")).digest())

    @classmethod
    def from_hex(cls, text: str) -> Self:
        """Read 64 hexadecimal digits."""
        return cls(seed_from_hex(text))

    def game(self, number: int, *, pairs: bool = False) -> GameSeeds:
        """The secrets of the ``number``-th game, from 0.

        With ``pairs``, games 0 and 1, 2 and 3, ... have the same racks (those of the even one): with the break
        alternating, both players get the same start. The noise is every game's own all the same, else the second
        game of a pair could be played with the first one's noise known.
        """
        racked_as = number - number % 2 if pairs else number
        return GameSeeds(
            noise=_derive(self.secret, f"pooliad/1 game {number} noise"),
            racks=_derive(self.secret, f"pooliad/1 game {racked_as} racks"),
        )

    @property
    def first_breaker(self) -> int:
        """The seat that breaks the first game (R50): the lowest bit of the derivation's last byte."""
        return _derive(self.secret, "pooliad/1 first breaker")[-1] & 1

    def breaker(self, number: int) -> int:
        """The seat that breaks the ``number``-th game: the break alternates (R50)."""
        return breaker(self.first_breaker, number)


def commitment(seed: bytes) -> str:
    """SHA-256 of a seed, as 64 hexadecimal digits."""
    return hashlib.sha256(seed).hexdigest()


def seed_from_hex(text: str) -> bytes:
    """Read 64 hexadecimal digits; ValueError if it is anything else."""
    try:
        seed = bytes.fromhex(text)
    except (TypeError, ValueError):
        seed = b""
    if len(seed) != SEED_BYTES:
        raise ValueError(f"seed of {len(str(text))} characters: must be {2 * SEED_BYTES} hexadecimal digits")
    return seed


def _derive(key: bytes, label: str) -> bytes:
    return hmac.digest(key, label.encode("ascii"), "sha256")


def _check_seed(name: str, seed: bytes) -> None:
    """Raise unless ``seed`` is 32 bytes; the message does not repeat it, it may be a secret."""
    if not isinstance(seed, bytes) or len(seed) != SEED_BYTES:
        size = f"{len(seed)} bytes" if isinstance(seed, bytes) else type(seed).__name__
        raise ValueError(f"{name} = <{size}>: must be {SEED_BYTES} bytes")
