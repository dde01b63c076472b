"""Seeds and commitments: docs/protocol.md, Seeds."""

import hashlib
import hmac

import pytest

from referee.play import GameSeeds, MatchSeed, commitment, seed_from_hex

SEED = MatchSeed(bytes(range(32)))


def test_derivations_are_as_specified():
    """The labels are part of the record format: golden."""

    def derive(key, label):
        return hmac.digest(key, label, hashlib.sha256)

    third = SEED.game(3)
    assert third.noise == derive(SEED.secret, b"pooliad/1 game 3 noise")
    assert third.racks == derive(SEED.secret, b"pooliad/1 game 3 racks")
    assert third.rack(2) == derive(third.racks, b"pooliad/1 rack 2")
    assert SEED.first_breaker == derive(SEED.secret, b"pooliad/1 first breaker")[31] % 2


def test_golden_values():
    seeds = SEED.game(0)
    assert seeds.noise.hex() == "b9d15898cd10b64a530d397ebff8643cb405973a4c43fd38663c03fa4394cccf"
    assert seeds.racks.hex() == "ad2a3940b4f16c9f4876537d7caacf90d72bffff0645fd914baad8a2b07a85a4"
    assert seeds.rack(0).hex() == "200fe615356c4126054ff984b8bca31947704b52c6616d5358b2ef4496b72cb1"
    assert MatchSeed.of(7).secret.hex() == "f3e8c0df86a964bbb2379ca0c681d81eb00f168ea92210d35bebb0e656ea2819"


def test_the_games_of_a_pair_share_their_racks_and_never_their_noise():
    games = [SEED.game(number, pairs=True) for number in range(6)]
    for even, odd in zip(games[::2], games[1::2], strict=True):
        assert even.racks == odd.racks
        assert even.noise != odd.noise
    assert len({game.racks for game in games}) == 3
    assert [game.noise for game in games] == [SEED.game(number).noise for number in range(6)]
    assert [SEED.breaker(n) for n in (0, 2, 4)] == [1 - SEED.breaker(n) for n in (1, 3, 5)]


def test_no_two_derivations_are_equal():
    games = [SEED.game(number) for number in range(20)]
    derived = [seeds.noise for seeds in games] + [seeds.racks for seeds in games]
    derived += [seeds.rack(index) for seeds in games for index in range(3)]
    assert len(set(derived)) == len(derived)


def test_commitment_is_sha_256_of_the_noise_seed():
    """Issue: published before the break, the seed after the game."""
    seeds = SEED.game(0)
    assert seeds.commitment == hashlib.sha256(seeds.noise).hexdigest() == commitment(seeds.noise)


def test_secrets_do_not_show_in_a_log():
    seeds = SEED.game(0)
    shown = f"{SEED} {SEED!r} {seeds} {seeds!r}"
    for secret in (SEED.secret, seeds.noise, seeds.racks):
        assert secret.hex() not in shown
        assert repr(secret) not in shown


def test_games_of_a_pair_can_share_racks_but_not_noise():
    first, second = SEED.game(0), SEED.game(1)
    swapped = GameSeeds(noise=second.noise, racks=first.racks)
    assert swapped.rack(0) == first.rack(0)
    assert swapped.commitment != first.commitment


def test_break_alternates_from_the_seeds_choice():
    """R50."""
    assert [SEED.breaker(number) for number in range(4)] == [
        SEED.first_breaker,
        1 - SEED.first_breaker,
        SEED.first_breaker,
        1 - SEED.first_breaker,
    ]
    assert {MatchSeed.of(seed).first_breaker for seed in range(20)} == {0, 1}


def test_fresh_seeds_differ():
    assert MatchSeed.fresh() != MatchSeed.fresh()


def test_hex_round_trip():
    assert MatchSeed.from_hex(SEED.secret.hex()) == SEED


@pytest.mark.parametrize("text", ["", "00" * 31, "0" * 63, "zz" * 32, None, 7])
def test_bad_hex_is_refused(text):
    with pytest.raises(ValueError, match="must be 64 hexadecimal digits"):
        seed_from_hex(text)


@pytest.mark.parametrize("bad", [b"", b"short", "text", None])
def test_bad_secrets_are_refused_without_repeating_them(bad):
    with pytest.raises(ValueError, match="must be 32 bytes") as caught:
        GameSeeds(noise=bad, racks=bytes(32))
    assert "short" not in str(caught.value)


@pytest.mark.parametrize("bad", [-1, True, 1.5, "7"])
def test_repeatable_seeds_are_integers(bad):
    with pytest.raises(ValueError, match="must be an integer >= 0"):
        MatchSeed.of(bad)
