"""Running games are kept between requests, the ones that are asked for longer than others."""

from support.server_time import Stage

from server.services.play import budget, game_cache, live_game
from server.services.play.clock import columns, standstill
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


def test_what_changes_while_a_version_stays_is_read_anew(tmp_path):
    """A remembered game is the database's in every column: after a fetch, a pause, simulated shots, and a stroke."""
    stage, seen = Stage(tmp_path / "seen.db"), GameCache()
    seats = stage.game("ann", "bob", clock={"seconds": 60, "simulations": 100})

    def as_stored():
        with stage.context.database.reading() as connection:
            found, stored = seen.find(connection, seats.id), live_game.find(connection, seats.id)
        assert found.row == stored.row
        assert found.game == stored.game
        return found.row

    first = as_stored()
    seats.fetch()
    fetched = as_stored()
    assert (first.delivered, fetched.delivered) == (False, True)
    budget.count(stage.context, stage.command(seats.mover, key="simulated"), seats.id, 7)
    assert sorted((as_stored().simulated_0, as_stored().simulated_1)) == [0, 7]
    with stage.context.writing() as writing:
        standstill.hold(writing, writing.now)
    assert as_stored().available_at == columns.HELD
    standstill.release(stage.context)
    assert as_stored().available_at < columns.HELD
    seats.fetch()
    seats.concede()
    assert as_stored().version == first.version + 1
    stage.close()


def test_all_columns_of_a_clock_are_read_anew(tmp_path):
    stage = Stage(tmp_path / "seen.db")
    seats = stage.game("ann", "bob")
    with stage.context.database.reading() as connection:
        live = live_game.find(connection, seats.id)
    assert set(columns.written(live.clock, stage.context.settings)) == set(columns.COLUMNS)
    stage.close()
