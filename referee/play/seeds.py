"""Secrets of a match: two chains of links, one for the noise and one for the racks, and what follows from them.

The secrets are drawn before the players say anything, and what is published then (the anchors, within the
commitment of ``referee.record.MatchTerms``) fixes them for every game of the match. The players may add seeds
of their own afterwards; noise and racks follow from both, so that neither side can choose them::

    link 999 = HMAC-SHA-256(secret, "pooliad/1 noise chain")        and "pooliad/1 rack chain"
    link g   = SHA-256(link g + 1)                                  the secret of game g
    anchor   = SHA-256(link 0)                                      committed to before any seed of the players
    seed     = HMAC-SHA-256(link g, "pooliad/1 noise A B")          A, B: the players' seeds, "-" for none

When game g is over its links are revealed: hashing them g + 1 times gives the anchors, and hashing goes only
towards games that are over, so a revealed link gives nothing of the next game away. Labels and steps are part
of the record format (docs/protocol.md).
"""

import hashlib
import hmac
import secrets
from dataclasses import dataclass, field
from typing import Final, Self

from referee.rules import breaker

SEED_BYTES = 32
"""256 bits: out of reach of any search."""

LINKS: Final = 1000
"""Links of a chain, and so the greatest number of games in a match."""

ClientSeeds = tuple[bytes | None, bytes | None]
"""What the players added to the draw, by seat: 32 bytes each, None where a player added nothing."""

NO_CLIENT_SEEDS: Final[ClientSeeds] = (None, None)


@dataclass(frozen=True, slots=True)
class GameSeeds:
    """The two secrets of one game. Neither shows in ``repr``, so neither slips into a log.

    Whoever searches ahead or experiments makes one from bytes of its own.

    Attributes:
        noise: 32 bytes, the link of the noise chain.
        racks: 32 bytes, the link of the rack chain. Two games may share it and play equal racks.
        client_seeds: what the players added.
        shared_racks: the racks are to equal those of other games: the players' seeds stay out of them.
    """

    noise: bytes = field(repr=False)
    racks: bytes = field(repr=False)
    client_seeds: ClientSeeds = NO_CLIENT_SEEDS
    shared_racks: bool = False
    _noise_seed: bytes | None = field(default=None, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        _check_seed("noise", self.noise)
        _check_seed("racks", self.racks)

    @property
    def noise_seed(self) -> bytes:
        """32 bytes; with a stroke's index they fix that stroke's noise."""
        if self._noise_seed is None:  # every stroke asks for it
            object.__setattr__(self, "_noise_seed", _derive(self.noise, f"pooliad/1 noise {_mixed(self.client_seeds)}"))
        assert self._noise_seed is not None
        return self._noise_seed

    @property
    def rack_seed(self) -> bytes:
        """32 bytes; with a rack's index they fix that rack."""
        clients = "shared" if self.shared_racks else _mixed(self.client_seeds)
        return _derive(self.racks, f"pooliad/1 racks {clients}")

    def rack(self, index: int) -> bytes:
        """The seed of the game's ``index``-th rack, for ``physics.rack``."""
        return _derive(self.rack_seed, f"pooliad/1 rack {index}")

    def first_breaker(self, number: int) -> int:
        """The seat drawn to break the match's first game (R50), this being the ``number``-th."""
        first = hashed(self.noise, number)
        return _derive(first, f"pooliad/1 first breaker {_mixed(self.client_seeds)}")[-1] & 1


@dataclass(frozen=True, slots=True)
class MatchSeed:
    """The secret from which everything random in a match comes, and what was added to it.

    Attributes:
        secret: 32 bytes.
        given_racks: 32 bytes from which the racks come instead; matches that share them play equal racks, and
            whoever knows them knows nothing of the noise. None: the racks come from the secret, too.
        client_seeds: what the players added.
    """

    secret: bytes = field(repr=False)
    given_racks: bytes | None = field(default=None, repr=False)
    client_seeds: ClientSeeds = NO_CLIENT_SEEDS
    _links: list[list[bytes]] = field(default_factory=list, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        _check_seed("secret", self.secret)
        if self.given_racks is not None:
            _check_seed("given_racks", self.given_racks)
        for seat, seed in enumerate(self.client_seeds):
            if seed is not None:
                _check_seed(f"client_seeds[{seat}]", seed)

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

    @property
    def shared_racks(self) -> bool:
        """Whether other matches may have the same racks."""
        return self.given_racks is not None

    def game(self, number: int, *, pairs: bool = False) -> GameSeeds:
        """The secrets of the ``number``-th game, from 0 to 999.

        With ``pairs``, games 0 and 1, 2 and 3, ... have the same racks: with the break alternating, both players
        get the same start. The noise is every game's own all the same, else the second game of a pair could be
        played with the first one's noise known.
        """
        if not self._links:
            self._links[:] = [_chain(end) for end in self._ends()]
        noise, racks = self._links
        return GameSeeds(
            noise=noise[_game_number(number)],
            racks=racks[rack_link(number, pairs)],
            client_seeds=self.client_seeds,
            shared_racks=self.shared_racks,
        )

    @property
    def first_breaker(self) -> int:
        """The seat drawn to break the first game (R50)."""
        return self.game(0).first_breaker(0)

    def breaker(self, number: int) -> int:
        """The seat that breaks the ``number``-th game: the break alternates (R50)."""
        return breaker(self.first_breaker, number)

    def _ends(self) -> tuple[bytes, bytes]:
        """The last links of both chains."""
        racks = self.secret if self.given_racks is None else self.given_racks
        return _derive(self.secret, "pooliad/1 noise chain"), _derive(racks, "pooliad/1 rack chain")


def _chain(end: bytes) -> list[bytes]:
    """Every link of a chain by its number, from the last one."""
    links = [end]
    for _ in range(LINKS - 1):
        links.append(hashlib.sha256(links[-1]).digest())
    return links[::-1]


def rack_link(number: int, pairs: bool) -> int:
    """Which link of the rack chain is the ``number``-th game's."""
    return number // 2 if pairs else number


def anchor(link: bytes, index: int) -> bytes:
    """The end of the chain that the ``index``-th link leads to: what was committed to."""
    return hashed(link, index + 1)


def hashed(link: bytes, times: int) -> bytes:
    """The link so many steps nearer to the anchor."""
    for _ in range(times):
        link = hashlib.sha256(link).digest()
    return link


def seed_from_hex(text: str) -> bytes:
    """Read 64 hexadecimal digits; ValueError if it is anything else."""
    try:
        seed = bytes.fromhex(text)
    except (TypeError, ValueError):
        seed = b""
    if len(seed) != SEED_BYTES or len(text) != 2 * SEED_BYTES:
        raise ValueError(f"seed of {len(str(text))} characters: must be {2 * SEED_BYTES} hexadecimal digits")
    return seed


def client_seeds_from_hex(texts: tuple[str | None, str | None]) -> ClientSeeds:
    """Read both players' seeds, by seat; ValueError if one is neither None nor 64 hexadecimal digits."""
    first, second = (None if text is None else seed_from_hex(text) for text in texts)
    return first, second


def _mixed(client_seeds: ClientSeeds) -> str:
    """Both players' seeds as labels hold them."""
    return " ".join("-" if seed is None else seed.hex() for seed in client_seeds)


def _derive(key: bytes, label: str) -> bytes:
    return hmac.digest(key, label.encode("ascii"), "sha256")


def _game_number(number: int) -> int:
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < LINKS:
        raise ValueError(f"game number = {number!r}: must be an integer in [0, {LINKS})")
    return number


def _check_seed(name: str, seed: bytes) -> None:
    """Raise unless ``seed`` is 32 bytes; the message does not repeat it, it may be a secret."""
    if not isinstance(seed, bytes) or len(seed) != SEED_BYTES:
        size = f"{len(seed)} bytes" if isinstance(seed, bytes) else type(seed).__name__
        raise ValueError(f"{name} = <{size}>: must be {SEED_BYTES} bytes")
