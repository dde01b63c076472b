"""The project's own random numbers: HMAC-SHA-256 in counter mode (specified in ``docs/protocol.md``).

Racks and execution noise depend on these numbers, and a game must be verifiable years later and in another
language. So nothing here leans on a library stream or on the platform's mathematics: after the hash come
integers, ``+ - * /`` on doubles, correctly rounded square roots and ``frexp``, which are the same everywhere.
"""

import hmac
import math
import struct
from collections.abc import MutableSequence
from typing import Any, Final

_FOUR_WORDS: Final = struct.Struct(">4Q").unpack
_WORDS: Final = 1 << 64
_UNIT: Final = 1.0 / (1 << 53)
"""2^-53: the spacing of the uniform numbers."""


class SeededStream:
    """An endless stream of random numbers, fixed by a secret key and a label.

    Block i = 0, 1, … is HMAC-SHA-256(key, label in UTF-8 + one zero byte + i as 8 bytes big-endian) and gives
    four 64-bit words, big-endian. Streams with different labels under one key are independent.

    Args:
        key: secret, usually 32 bytes.
        label: what the stream is for.
    """

    __slots__ = ("_key", "_message", "_next_block", "_words")

    def __init__(self, key: bytes, label: str) -> None:
        self._key = key
        self._message = label.encode() + b"\0"
        self._next_block = 0
        self._words: list[int] = []

    def __repr__(self) -> str:
        return f"<SeededStream {self._message[:-1].decode()!r}>"

    def word(self) -> int:
        """The next 64 bits, as an integer."""
        if not self._words:
            block = hmac.digest(self._key, self._message + self._next_block.to_bytes(8, "big"), "sha256")
            self._words.extend(reversed(_FOUR_WORDS(block)))
            self._next_block += 1
        return self._words.pop()

    def uniform(self) -> float:
        """A number in (0, 1): k / 2^53 with k the top 53 bits of a word, drawn again when k = 0."""
        while True:
            bits = self.word() >> 11
            if bits:
                return bits * _UNIT

    def below(self, n: int) -> int:
        """An integer in [0, n), each exactly equally likely.

        A word w gives w mod n; words from the greatest multiple of n up are drawn again.

        Raises:
            ValueError: n is not in [1, 2^64].
        """
        if not 1 <= n <= _WORDS:
            raise ValueError(f"n = {n!r}: must be in [1, 2**64]")
        limit = _WORDS - _WORDS % n
        while True:
            word = self.word()
            if word < limit:
                return word % n

    def shuffle(self, items: MutableSequence[Any]) -> None:
        """Put ``items`` in random order: for i from the last to 1, swap items i and below(i + 1)."""
        for i in range(len(items) - 1, 0, -1):
            j = self.below(i + 1)
            items[i], items[j] = items[j], items[i]

    def gaussian(self) -> float:
        """A standard normal number: ``normal_quantile`` of a uniform one, so |z| < 8.21."""
        return normal_quantile(self.uniform())


def normal_quantile(p: float) -> float:
    """The inverse of the standard normal distribution at p in (0, 1): AS 241, PPND16 (Wichura 1988).

    Applied Statistics 37(3), 477-484. For every p that ``SeededStream.uniform`` gives, the result is within
    1e-15 relative of the true value (worst seen: 6e-16).
    """
    q = p - 0.5
    if abs(q) <= 0.425:
        r = 0.180625 - q * q
        return q * _horner(_A, r) / _horner(_B, r)
    r = math.sqrt(-natural_logarithm(p if q < 0.0 else 1.0 - p))
    near = r <= 5.0
    z = _horner(_C, r - 1.6) / _horner(_D, r - 1.6) if near else _horner(_E, r - 5.0) / _horner(_F, r - 5.0)
    return -z if q < 0.0 else z


def natural_logarithm(x: float) -> float:
    """ln x for a normal x > 0, within 1 ulp, by a fixed sequence of + - * / after ``frexp``.

    The method of fdlibm's ``e_log.c`` (Sun Microsystems 1993): x = 2^k (1 + f), 1 + f in [sqrt(1/2),
    sqrt(2)), s = f / (2 + f), ln(1 + f) = f - (f^2/2 - s (f^2/2 + R)) where R = z P(z), z = s^2, P of degree
    6.
    """
    mantissa, exponent = math.frexp(x)
    if mantissa < _SQRT_HALF:
        mantissa, exponent = 2.0 * mantissa, exponent - 1
    f = mantissa - 1.0
    k = float(exponent)
    s = f / (2.0 + f)
    z = s * s
    half_square = 0.5 * f * f
    series = z * _horner(_LOG, z)
    return k * _LN2_HIGH - ((half_square - (s * (half_square + series) + k * _LN2_LOW)) - f)


def _horner(coefficients: tuple[float, ...], x: float) -> float:
    """Evaluate a polynomial, highest coefficient first: ((c0 x + c1) x + c2) x + …."""
    value = 0.0
    for coefficient in coefficients:
        value = value * x + coefficient
    return value


_SQRT_HALF: Final = 0.7071067811865476
_LN2_HIGH: Final = 6.93147180369123816490e-01
"""ln 2 to 33 bits: k times it is exact."""
_LN2_LOW: Final = 1.90821492927058770002e-10
_LOG: Final = (
    1.479819860511658591e-01,
    1.531383769920937332e-01,
    1.818357216161805012e-01,
    2.222219843214978396e-01,
    2.857142874366239149e-01,
    3.999999999940941908e-01,
    6.666666666666735130e-01,
)

# AS 241, highest power first. A/B: |p - 1/2| <= 0.425; C/D: out to p = e^-25; E/F: beyond.
_A: Final = (
    2.5090809287301226727e3,
    3.3430575583588128105e4,
    6.7265770927008700853e4,
    4.5921953931549871457e4,
    1.3731693765509461125e4,
    1.9715909503065514427e3,
    1.3314166789178437745e2,
    3.3871328727963666080e0,
)
_B: Final = (
    5.2264952788528545610e3,
    2.8729085735721942674e4,
    3.9307895800092710610e4,
    2.1213794301586595867e4,
    5.3941960214247511077e3,
    6.8718700749205790830e2,
    4.2313330701600911252e1,
    1.0,
)
_C: Final = (
    7.74545014278341407640e-4,
    2.27238449892691845833e-2,
    2.41780725177450611770e-1,
    1.27045825245236838258e0,
    3.64784832476320460504e0,
    5.76949722146069140550e0,
    4.63033784615654529590e0,
    1.42343711074968357734e0,
)
_D: Final = (
    1.05075007164441684324e-9,
    5.47593808499534494600e-4,
    1.51986665636164571966e-2,
    1.48103976427480074590e-1,
    6.89767334985100004550e-1,
    1.67638483018380384940e0,
    2.05319162663775882187e0,
    1.0,
)
_E: Final = (
    2.01033439929228813265e-7,
    2.71155556874348757815e-5,
    1.24266094738807843860e-3,
    2.65321895265761230930e-2,
    2.96560571828504891230e-1,
    1.78482653991729133580e0,
    5.46378491116411436990e0,
    6.65790464350110377720e0,
)
_F: Final = (
    2.04426310338993978564e-15,
    1.42151175831644588870e-7,
    1.84631831751005468180e-5,
    7.86869131145613259100e-4,
    1.48753612908506148525e-2,
    1.36929880922735805310e-1,
    5.99832206555887937690e-1,
    1.0,
)
