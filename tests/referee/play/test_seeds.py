"""Seeds and commitments: docs/protocol.md, Seeds."""

import hashlib
import hmac
import random
import time

import pytest

from referee.play import GameSeeds, MatchSeed, client_seeds_from_hex, seed_from_hex
from referee.play.seeds import anchor, hashed

SEED = MatchSeed(bytes(range(32)))


CLIENTS = (bytes([1]) * 32, bytes([2]) * 32)


def derive(key, label):
    return hmac.digest(key, label.encode(), hashlib.sha256)


def sha(link):
    return hashlib.sha256(link).digest()


def test_derivations_are_as_specified():
    """docs/protocol.md, Seeds: chains, labels and what the players add, written out a second time."""
    noise, racks = derive(SEED.secret, "pooliad/1 noise chain"), derive(SEED.secret, "pooliad/1 rack chain")
    for _ in range(1000 - 1 - 3):
        noise, racks = sha(noise), sha(racks)
    third = SEED.game(3)
    assert (third.noise, third.racks) == (noise, racks)
    assert third.noise_seed == derive(noise, "pooliad/1 noise - -")
    assert third.rack(2) == derive(derive(racks, "pooliad/1 racks - -"), "pooliad/1 rack 2")
    first = sha(sha(sha(noise)))
    assert SEED.first_breaker == derive(first, "pooliad/1 first breaker - -")[31] % 2
    mixed = MatchSeed(SEED.secret, client_seeds=CLIENTS).game(3)
    texts = f"{'01' * 32} {'02' * 32}"
    assert mixed.noise_seed == derive(noise, f"pooliad/1 noise {texts}")
    assert mixed.rack_seed == derive(racks, f"pooliad/1 racks {texts}")
    assert mixed.first_breaker(3) == derive(first, f"pooliad/1 first breaker {texts}")[31] % 2


def test_golden_values():
    seeds = SEED.game(0)
    assert seeds.noise.hex() == "901c0cdb056f0ac8f623df6f1241bc42365093844e3f33c7c3b643730d2c488b"
    assert seeds.racks.hex() == "944748aa37959384ddadae3081964ac89b9a1ea4cb0cf707f8307981d890a5b2"
    assert seeds.noise_seed.hex() == "5f93fa44d390d22883812b153f799b5d49333e6e26b14ff99c7194fb9d4b0bc9"
    assert seeds.rack(0).hex() == "d3e7cc4a432b87a5e40417c4cd1dbbc9473da376d54156c20235842bbd426f60"
    assert MatchSeed.of(7).secret.hex() == "f3e8c0df86a964bbb2379ca0c681d81eb00f168ea92210d35bebb0e656ea2819"


def test_every_game_of_a_match_leads_to_the_same_anchors():
    games = [SEED.game(number) for number in (0, 1, 2, 999)]
    assert len({anchor(game.noise, number) for game, number in zip(games, (0, 1, 2, 999), strict=True)}) == 1
    assert len({anchor(game.racks, number) for game, number in zip(games, (0, 1, 2, 999), strict=True)}) == 1
    assert anchor(games[0].noise, 0) != anchor(games[0].racks, 0)


def test_a_revealed_link_leads_to_games_that_are_over_alone():
    """Hashing goes from later games to earlier ones, and never back."""
    third = SEED.game(3)
    earlier = {hashed(third.noise, steps) for steps in range(1, 4)}
    assert earlier == {SEED.game(number).noise for number in (0, 1, 2)}
    later = {SEED.game(number).noise for number in range(4, 1000)}
    assert not later & {hashed(third.noise, steps) for steps in range(2000)}


def test_each_player_alone_changes_everything():
    """Issue: optional client seeds; swapping them between the seats is another draw, too."""
    one, other = CLIENTS
    draws = [(None, None), (one, None), (None, one), (one, other), (other, one), (one, one)]
    games = [MatchSeed(SEED.secret, client_seeds=draw).game(0) for draw in draws]
    assert len({game.noise_seed for game in games}) == len(draws)
    assert len({game.rack(0) for game in games}) == len(draws)
    assert len({game.noise for game in games}) == 1


def test_matches_can_share_racks_without_knowing_the_noise():
    """Paired games of a tournament: equal racks whatever the players add, and noise of each match's own."""
    racks = bytes([9]) * 32
    one = MatchSeed(bytes(32), racks, CLIENTS).game(0)
    other = MatchSeed(SEED.secret, racks).game(0)
    assert one.rack(0) == other.rack(0)
    assert one.noise_seed != other.noise_seed
    assert one.noise_seed == MatchSeed(bytes(32), client_seeds=CLIENTS).game(0).noise_seed
    assert one.rack(0) != MatchSeed(bytes(32), client_seeds=CLIENTS).game(0).rack(0)


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
    derived += [seeds.noise_seed for seeds in games] + [seeds.rack_seed for seeds in games]
    derived += [seeds.rack(index) for seeds in games for index in range(3)]
    assert len(set(derived)) == len(derived)


def test_secrets_do_not_show_in_a_log():
    seeds = SEED.game(0)
    shown = f"{SEED} {SEED!r} {seeds} {seeds!r}"
    for secret in (SEED.secret, seeds.noise, seeds.racks):
        assert secret.hex() not in shown
        assert repr(secret) not in shown


def test_break_alternates_from_the_seeds_choice():
    """R50."""
    assert [SEED.breaker(number) for number in range(4)] == [
        SEED.first_breaker,
        1 - SEED.first_breaker,
        SEED.first_breaker,
        1 - SEED.first_breaker,
    ]
    assert {MatchSeed.of(seed).first_breaker for seed in range(20)} == {0, 1}


def test_fresh_seeds_come_from_neither_clock_nor_generator(monkeypatch):
    """Historical: noise followed from the time at which the server was started."""
    monkeypatch.setattr(time, "time", lambda: 0.0)
    monkeypatch.setattr(time, "time_ns", lambda: 0)
    drawn = []
    for _ in range(3):
        random.seed(7)
        drawn.append(MatchSeed.fresh().secret)
    assert len(set(drawn)) == 3


def test_hex_round_trip():
    assert MatchSeed.from_hex(SEED.secret.hex()) == SEED


@pytest.mark.parametrize("text", ["", "00" * 31, "0" * 63, "zz" * 32, "00 " * 32, None, 7])
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


@pytest.mark.parametrize("number", [-1, 1000, 10**30, 1.0, True])
def test_a_match_has_games_0_to_999(number):
    with pytest.raises(ValueError, match=r"game number = .*: must be an integer in \[0, 1000\)"):
        SEED.game(number)


def test_client_seeds_are_none_or_hex():
    assert client_seeds_from_hex((None, "01" * 32)) == (None, CLIENTS[0])
    with pytest.raises(ValueError, match="must be 64 hexadecimal digits"):
        client_seeds_from_hex((None, "01"))
    with pytest.raises(ValueError, match=r"client_seeds\[1\] = <3 bytes>: must be 32 bytes"):
        MatchSeed(SEED.secret, client_seeds=(None, b"abc"))
