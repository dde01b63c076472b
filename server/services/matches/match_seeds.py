"""The draw of a match as the database keeps it: its secrets, its commitment, what the players added."""

from collections.abc import Mapping
from typing import Any

from sqlalchemy import Row

from physics import Table
from protocol import MatchRequest, Position
from referee.game import Game
from referee.play import GameSeeds, MatchSeed, NoiseModel, client_seeds_from_hex, seed_from_hex
from referee.play.clock import nanoseconds
from referee.play.noise import OLYMPIAD_SIGMAS, Sigmas
from referee.record import Engine, MatchTerms
from referee.rules import EightBall
from server.store.rows import GameRow


def columns(request: MatchRequest, match_id: str) -> dict[str, Any]:
    """The columns of a new match that its draw rests on; the secrets are fresh unless an organiser gave them."""
    given = request.racks.seed
    seed = MatchSeed(
        MatchSeed.fresh().secret if request.seed is None else seed_from_hex(request.seed),
        None if given is None else seed_from_hex(given),
    )
    terms = MatchTerms(
        match=match_id,
        games=request.games,
        rules=EightBall(Table.from_dict(request.table)),
        noise=request.noise.model(),
        shared_racks=seed.shared_racks,
        paired_racks=request.racks.paired,
        first_breaker=request.first_breaker,
        position=_position(request.table, request.start),
    )
    return {
        "seed": seed.secret.hex(),
        "rack_seed": given,
        "paired_racks": request.racks.paired,
        "given_breaker": request.first_breaker,
        "engine": terms.engine.digest,
        "engine_version": terms.engine.version,
        "commitment": terms.commitment_to(seed),
        "opening": nanoseconds(request.client_seed_seconds),
    }


def terms_of(match: Row[Any]) -> MatchTerms:
    """What this match is committed to."""
    return MatchTerms(
        match=match.id,
        games=match.games,
        rules=EightBall(Table.from_dict(match.table)),
        noise=noise_of(match),
        shared_racks=match.rack_seed is not None,
        paired_racks=match.paired_racks,
        first_breaker=match.given_breaker,
        position=position_of(match),
        engine=Engine(match.engine_version, match.engine),
    )


def noise_of(match: Row[Any]) -> NoiseModel:
    """The execution noise of a match."""
    sigmas = OLYMPIAD_SIGMAS if match.noise_sigmas is None else Sigmas.from_dict(match.noise_sigmas)
    return NoiseModel(match.noise_level, match.noise_told, sigmas)


def position_of(match: Row[Any]) -> Game | None:
    """Where the match's games begin, None when they begin with a break."""
    return _position(match.table, None if match.start is None else Position.model_validate(match.start))


def first_breaker(match: Row[Any]) -> int:
    """Who breaks the first game, or would, now that the players can add nothing any more."""
    if (position := position_of(match)) is not None:
        return position.breaker
    if match.given_breaker is not None:
        return int(match.given_breaker)
    return _seed(match).first_breaker


def game_seeds(match: Row[Any], number: int) -> GameSeeds:
    """The secrets of a game of this match, from the match's."""
    return _seed(match).game(number, pairs=match.paired_racks)


def kept_seeds(match: Row[Any], game: GameRow) -> GameSeeds:
    """The secrets of a game that has begun, as they are kept with it."""
    return GameSeeds(
        noise=seed_from_hex(game.noise_secret),
        racks=seed_from_hex(game.rack_secret),
        client_seeds=client_seeds_from_hex((match.client_seed_0, match.client_seed_1)),
        shared_racks=match.rack_seed is not None,
    )


def _position(table: Mapping[str, Any], start: Position | None) -> Game | None:
    """What a match is committed to is the referee's reading of its start: records hold that one."""
    return None if start is None else EightBall(Table.from_dict(table)).begin_from(start.to_game())


def _seed(match: Row[Any]) -> MatchSeed:
    return MatchSeed(
        seed_from_hex(match.seed),
        None if match.rack_seed is None else seed_from_hex(match.rack_seed),
        client_seeds_from_hex((match.client_seed_0, match.client_seed_1)),
    )
