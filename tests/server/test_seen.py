"""Running games are kept between requests, the ones that are asked for longer than others."""

from support.server_time import Stage

from server.services.play import game_cache
from server.services.play.game_cache import GameCache


def test_the_game_looked_for_longest_ago_is_forgotten_first(tmp_path, monkeypatch):
    """A game that was found there stayed where it was: of a thousand others the busiest was forgotten first."""
    monkeypatch.setattr(game_cache, "MOST_KEPT", 2)
    stage, games = Stage(tmp_path / "seen.db"), GameCache()
    first, second, third = (stage.game(f"ann {number}", f"bob {number}").id for number in range(3))
    with stage.context.database.reading() as connection:
        known = {game: games.find(connection, game).fixture for game in (first, second, first, third)}
        assert games.find(connection, first).fixture is known[first]
        assert games.find(connection, second).fixture is not known[second]
    stage.close()
