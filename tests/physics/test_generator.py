"""The specified generator: golden values, distribution, and AS 241 against arbitrary precision."""

import hashlib
import hmac
import math

import mpmath
import numpy as np
import pytest
from scipy import stats

from physics.generator import SeededStream, natural_logarithm, normal_quantile

KEY = bytes(32)


def test_words_are_hmac_sha_256_in_counter_mode():
    """The definition, written out a second time (docs/protocol.md, The generator)."""
    blocks = b"".join(hmac.digest(KEY, b"test\0" + bytes(7) + bytes([i]), hashlib.sha256) for i in range(2))
    expected = [int.from_bytes(blocks[8 * i : 8 * i + 8], "big") for i in range(8)]
    stream = SeededStream(KEY, "test")
    assert [stream.word() for _ in range(8)] == expected


def test_golden_values():
    """Numbers another implementation must reproduce bit for bit."""
    first = SeededStream(KEY, "test")
    assert [hex(first.word()) for _ in range(2)] == ["0x43c3ecf78534e04a", "0x24104665321214b3"]
    second = SeededStream(KEY, "test")
    assert [second.uniform() for _ in range(3)] == [
        0.2647083381936741,
        0.1408733365115682,
        0.550412452988888,
    ]
    third = SeededStream(KEY, "test")
    assert [third.gaussian() for _ in range(5)] == [
        -0.6288967156626475,
        -1.0764038684683053,
        0.12670347668478515,
        0.6989881520308895,
        -1.4350799482055367,
    ]
    fourth = SeededStream(KEY, "test")
    assert [fourth.below(6) for _ in range(10)] == [4, 1, 1, 3, 0, 5, 2, 2, 4, 3]
    items = list(range(10))
    SeededStream(KEY, "test").shuffle(items)
    assert items == [1, 7, 9, 5, 2, 6, 0, 3, 4, 8]


def test_keys_and_labels_separate_streams():
    streams = [(KEY, "a"), (KEY, "b"), (b"\1" * 32, "a"), (KEY, "a\0"), (KEY, "")]
    firsts = {SeededStream(key, label).word() for key, label in streams}
    assert len(firsts) == len(streams)


def test_repr_does_not_show_the_key():
    assert repr(SeededStream(b"secret" * 6, "noise")) == "<SeededStream 'noise'>"


def test_uniform_numbers_are_uniform():
    stream = SeededStream(KEY, "uniform")
    numbers = [stream.uniform() for _ in range(20_000)]
    assert all(0.0 < number < 1.0 for number in numbers)
    assert stats.kstest(numbers, "uniform").pvalue > 0.001


def test_gaussian_numbers_are_normal():
    stream = SeededStream(KEY, "gaussian")
    numbers = np.array([stream.gaussian() for _ in range(20_000)])
    assert stats.kstest(numbers, "norm").pvalue > 0.001
    assert abs(numbers.mean()) < 4 / math.sqrt(len(numbers))
    assert abs(numbers.std() - 1.0) < 4 / math.sqrt(2 * len(numbers))
    assert abs(np.corrcoef(numbers[:-1], numbers[1:])[0, 1]) < 4 / math.sqrt(len(numbers))


@pytest.mark.parametrize("n", [2, 6, 7, 15])
def test_below_is_unbiased(n):
    stream = SeededStream(KEY, f"below {n}")
    counts = np.bincount([stream.below(n) for _ in range(2_000 * n)], minlength=n)
    assert len(counts) == n
    assert stats.chisquare(counts).pvalue > 0.001


def test_below_draws_again_above_the_greatest_multiple():
    """With n just over 2^63 half of all words would be folded onto small numbers."""
    n = (1 << 63) + 1
    stream, words = SeededStream(KEY, "test"), SeededStream(KEY, "test")
    kept = [word for word in (words.word() for _ in range(40)) if word < n]
    assert len(kept) < 30
    assert [stream.below(n) for _ in kept] == kept


@pytest.mark.parametrize("n", [0, -1, (1 << 64) + 1])
def test_below_refuses_empty_and_too_wide_ranges(n):
    with pytest.raises(ValueError, match=r"must be in \[1, 2\*\*64\]"):
        SeededStream(KEY, "test").below(n)


def test_below_takes_the_whole_range():
    assert SeededStream(KEY, "test").below(1 << 64) == SeededStream(KEY, "test").word()


def test_every_order_of_a_shuffle_is_equally_likely():
    stream = SeededStream(KEY, "shuffle")
    counts: dict[tuple[int, ...], int] = {}
    for _ in range(12_000):
        items = [0, 1, 2, 3]
        stream.shuffle(items)
        counts[tuple(items)] = counts.get(tuple(items), 0) + 1
    assert len(counts) == 24
    assert stats.chisquare(list(counts.values())).pvalue > 0.001


def probabilities():
    """Uniform numbers of the generator: the middle, both tails to the very end, and the borders of AS 241."""
    stream = SeededStream(KEY, "probabilities")
    middle = [stream.uniform() for _ in range(1_500)]
    tail = [stream.word() % (1 << 1 + stream.below(52)) | 1 for _ in range(1_500)]
    ends = [k * 2.0**-53 for k in tail] + [1.0 - k * 2.0**-53 for k in tail]
    near_half = [0.5 + sign * k * 2.0**-53 for k in tail for sign in (-1, 1) if k < 1 << 51]
    borders = [0.075, 0.925, math.exp(-25), 1.0 - math.exp(-25), 2.0**-53, 1.0 - 2.0**-53]
    return [p for p in middle + ends + near_half + borders if 0.0 < p < 1.0 and p != 0.5]


def test_normal_quantile_is_within_1e_15_of_the_truth():
    """One Newton step from the result, in 40 digits, is the error (the curvature adds its square)."""
    worst = 0.0
    with mpmath.workdps(40):
        for p in probabilities():
            z = mpmath.mpf(normal_quantile(p))
            tail = mpmath.erfc(abs(z) / mpmath.sqrt(2)) / 2
            target = mpmath.mpf(p) if p < 0.5 else 1 - mpmath.mpf(p)
            density = mpmath.exp(-z * z / 2) / mpmath.sqrt(2 * mpmath.pi)
            worst = max(worst, abs(float((tail - target) / density / z)))
    assert 0.0 < worst <= 1e-15


def test_normal_quantile_is_odd_and_zero_at_one_half():
    assert normal_quantile(0.5) == 0.0
    for p in (0.25, 0.0625, 2.0**-20, 2.0**-53):
        assert normal_quantile(1.0 - p) == -normal_quantile(p)


def test_natural_logarithm_is_within_one_ulp():
    with mpmath.workdps(40):
        for x in [*probabilities(), 1.5, 2.0, 1e300, math.sqrt(0.5), math.sqrt(2.0)]:
            error = abs(mpmath.mpf(natural_logarithm(x)) - mpmath.log(mpmath.mpf(x)))
            assert error <= math.ulp(math.log(x))
    assert natural_logarithm(1.0) == 0.0
