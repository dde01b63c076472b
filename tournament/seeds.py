"""Everything drawn by lot in an event comes from its seed: order, lots, levels, racks, noise.

Derivations are HMAC-SHA-256 with a label, as in ``referee.play.seeds``. Racks belong to a pair, noise to one game of
it: were it the same in both, whoever plays the second game could know the first one's noise.
"""

import hashlib
import hmac

from physics import SeededStream
from referee.play import GameSeeds, MatchSeed
from tournament.pairings import Pair
from tournament.spec import Spec


def secret(spec: Spec) -> bytes:
    """The 32 bytes behind an event's seed."""
    if isinstance(spec.seed, str):
        return bytes.fromhex(spec.seed)
    return hashlib.sha256(f"pooliad/1 event {spec.seed}".encode("ascii")).digest()


def lot(spec: Spec, label: str) -> SeededStream:
    """The stream for one draw by lot, e.g. of the order of the entrants."""
    return SeededStream(_derive(spec, "lots"), f"pooliad/1 lot {label}")


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
