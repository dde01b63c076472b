"""Everything drawn by lot in an event comes from its seed: order, lots, levels, racks, noise.

Where a server has drawn the seed, order, lots and levels come from a second secret: an organiser who keeps the same
books is told that one, and it tells nothing of racks and noise.

Derivations are HMAC-SHA-256 with a label, as in ``referee.play.seeds``. Racks belong to a pair, noise to one game of
it: were it the same in both, whoever plays the second game could know the first one's noise.
"""

import hashlib
import hmac

from physics import SeededStream
from referee.play import GameSeeds, MatchSeed
from tournament.errors import InvalidSpec
from tournament.pairings import Pair
from tournament.spec import Spec


def secret(spec: Spec) -> bytes:
    """The 32 bytes behind an event's seed. Left out it is 0, where no server has drawn one: such an event repeats.

    Raises:
        InvalidSpec: a server has drawn it, and not revealed it yet.
    """
    if isinstance(spec.seed, str):
        return bytes.fromhex(spec.seed)
    if spec.seed is None and spec.lots is not None:
        raise InvalidSpec("seed", None, "must be the one that the server reveals when the event is over")
    return hashlib.sha256(f"pooliad/1 event {spec.seed or 0}".encode("ascii")).digest()


def lot(spec: Spec, label: str) -> SeededStream:
    """The stream for one draw by lot, e.g. of the order of the entrants."""
    key = _derive(spec, "lots") if spec.lots is None else bytes.fromhex(spec.lots)
    return SeededStream(key, f"pooliad/1 lot {label}")


def level(spec: Spec, pair_id: str, index: int) -> float:
    """The noise level of a pair, the ``index``-th of its meeting."""
    if spec.noise.range is None:
        return spec.noise.levels[index % len(spec.noise.levels)]
    low, high = spec.noise.range
    return low + (high - low) * lot(spec, f"level {pair_id}").uniform()


def game_seeds(spec: Spec, pair: Pair, leg: int, attempt: int = 0) -> GameSeeds:
    """The secrets of one game: the racks of its pair, and noise that no other game has, a replayed one included.

    They are those of the only game of the match that a server makes for it.
    """
    return match_seed(spec, pair, leg, attempt).game(0)


def match_seed(spec: Spec, pair: Pair, leg: int, attempt: int = 0) -> MatchSeed:
    """The secret of the match that is one game of the event."""
    return MatchSeed(
        _derive(spec, f"noise {pair.id} {leg} {attempt}"),
        given_racks=_derive(spec, f"racks {pair.id}"),
    )


def _derive(spec: Spec, label: str) -> bytes:
    return hmac.digest(secret(spec), f"pooliad/1 event {label}".encode(), "sha256")
