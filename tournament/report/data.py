"""Everything a report says, as JSON data: for an event, and for a standing server.

One object carries all of it; the page and the tables for analysis are made from it and from nothing else.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from tournament.luck import GameLuck
from tournament.report.moments import Moment
from tournament.results import GameResult
from tournament.scores import Key
from tournament.standings import standings
from tournament.statistics import Mean, Ratings, ladder, mean_of, rate, score_of
from tournament.tournament import Tournament

FORMAT = "pooliad-report/1"
MOST_LEVELS = 6
"""More different noise levels than this are put together in bins of one."""

Data = dict[str, Any]

_UNRATED: Data = {"ratings": [], "superiority": {"names": [], "likelihoods": []}}


def event_report(
    event: Tournament,
    luck: Mapping[Key, GameLuck] | None = None,
    *,
    rated: bool = True,
    moments: Sequence[Moment] = (),
    replays: Mapping[str, str] | None = None,
) -> Data:
    """The report of an event, finished or not; its terms say whether its dice were foreseeable.

    Args:
        event: as it stands.
        luck: of games, by pair id and leg, as far as it has been computed.
        rated: whether the entrants are rated; not where somebody else's players could foresee the dice.
        moments: turning points to show.
        replays: addresses of pages that play games, by the games' records.
    """
    test = event.test
    return {
        "format": FORMAT,
        "kind": "event",
        "name": event.spec.name,
        "terms": event.spec.published() | {"noise": event.spec.noise.to_dict()},  # the games below show it as well
        "state": {
            "finished": event.finished,
            "stopped": event.stopped,
            "played": len(event.games),
            "due": len(event.due),
            "withdrawn": sorted(event.withdrawn),
        },
        "test": None if test is None else test.to_dict(),
        "standings": [line.to_dict() for line in standings(event)],
        "byes": [{"round": bye.round, "player": bye.player} for bye in event.byes],
        "moments": [moment.to_dict() for moment in moments],
        **_common(event.counted, event.spec.names, luck or {}),
        **({} if rated else _UNRATED),
        "games": [_game(result, luck or {}, replays or {}) for result in _in_order(event)],
    }


def server_report(name: str, results: Sequence[GameResult], luck: Mapping[Key, GameLuck] | None = None) -> Data:
    """The report of a standing server: whoever played whom, in the order in which the games ended."""
    counted = [result for result in results if result.counts]
    names = tuple(dict.fromkeys(player for result in results for player in result.players))
    return {
        "format": FORMAT,
        "kind": "server",
        "name": name,
        "ladder": [rung.to_dict() for rung in ladder(counted)],
        **_common(counted, names, luck or {}),
        "games": [_game(result, luck or {}) for result in results],
    }


def _common(counted: Sequence[GameResult], names: Sequence[str], luck: Mapping[Key, GameLuck]) -> Data:
    """What both kinds say about the games that count."""
    by_player = {name: [game for game in counted if name in game.players] for name in names}
    ratings = rate(counted, names)
    return {
        "ratings": [rating.to_dict() for rating in ratings.table],
        "dispersion": ratings.dispersion,
        "bootstrap_dispersion": ratings.bootstrap_dispersion,
        "superiority": _superiority(ratings),
        "scores": [{"name": name, **score_of(games, name).to_dict()} for name, games in by_player.items()],
        "meetings": _meetings(counted),
        "noise": [row for name, games in by_player.items() for row in _by_noise(name, games, counted)],
        "fouls": [_fouls(name, games) for name, games in by_player.items()],
        "time": [_time(name, games) for name, games in by_player.items()],
        "ends": _ends(counted),
        "luck": [row for name, games in by_player.items() if (row := _luck(name, games, luck))],
    }


def _superiority(ratings: Ratings) -> Data:
    """Everybody against everybody, in the order of the ratings: how likely the row's entrant is the stronger one."""
    names = [one.name for one in ratings.table]
    order = [ratings.names.index(name) for name in names]
    return {"names": names, "likelihoods": ratings.superiorities()[order][:, order].round(4).tolist()}


def _meetings(counted: Sequence[GameResult]) -> list[Data]:
    """The cross table: every two players who met, from the side of the one named first."""
    met: dict[tuple[str, str], list[GameResult]] = {}
    for game in counted:
        one, other = game.players
        met.setdefault((one, other) if (one, other) in met or (other, one) not in met else (other, one), []).append(
            game
        )
    return [
        {
            "players": list(players),
            "points": [sum(game.points_of(name) for game in games) for name in players],
            "games": len(games),
            **score_of(games, players[0]).to_dict(),
        }
        for players, games in met.items()
    ]


def _by_noise(name: str, games: Sequence[GameResult], everybody: Sequence[GameResult]) -> list[Data]:
    """Score by noise level, the same bins for everybody."""
    levels = sorted({game.noise for game in everybody})
    bins = [(level, level) for level in levels]
    if len(levels) > MOST_LEVELS:
        bins = [(float(low), float(low + 1)) for low in range(5)]
    rows = []
    for low, high in bins:
        inside = [game for game in games if _inside(game.noise, low, high)]
        if inside:
            score = score_of(inside, name)
            rows.append(
                {
                    "name": name,
                    "from": low,
                    "to": high,
                    "games": len(inside),
                    "points": sum(game.points_of(name) for game in inside),
                    "pairs": score.pairs,
                    "low": score.low,
                    "high": score.high,
                }
            )
    return rows


def _inside(noise: float, low: float, high: float) -> bool:
    """A level in its bin; the last bin holds its upper end."""
    return low <= noise < high or (noise == high and high in (low, 5.0))


def _fouls(name: str, games: Sequence[GameResult]) -> Data:
    rules: Counter[str] = Counter()
    for game in games:
        rules.update(game.fouls[game.seat(name)])
    strokes = sum(game.strokes[game.seat(name)] for game in games)
    return {"name": name, "strokes": strokes, "fouls": rules.total(), "rules": dict(sorted(rules.items()))}


def _time(name: str, games: Sequence[GameResult]) -> Data:
    seconds = [game.seconds[game.seat(name)] for game in games]
    return {
        "name": name,
        "games": len(games),
        "seconds": sum(seconds),
        "longest": max(seconds, default=0.0),
        "strokes": sum(game.strokes[game.seat(name)] for game in games),
        "simulated": sum(game.simulated[game.seat(name)] for game in games),
    }


def _ends(counted: Sequence[GameResult]) -> list[Data]:
    """Why games ended, the most frequent reason first."""
    reasons = Counter(game.reason.value for game in counted)
    return [
        {"reason": reason, "games": count} for reason, count in sorted(reasons.items(), key=lambda e: (-e[1], e[0]))
    ]


def _luck(name: str, games: Sequence[GameResult], luck: Mapping[Key, GameLuck]) -> Data | None:
    """Luck per game of a player and the score without it, each with its interval."""
    found = [(game, luck[game.pair, game.leg]) for game in games if (game.pair, game.leg) in luck]
    if not found:
        return None
    pairs = [(game.pair, game.players[1 - game.seat(name)]) for game, _ in found]
    return {
        "name": name,
        "games": len(found),
        **_interval("score", mean_of([game.points_of(name) for game, _ in found], pairs)),
        **_interval("luck", mean_of([each.of(game.seat(name)) for game, each in found], pairs)),
        **_interval("corrected", mean_of([each.corrected(game.seat(name)) for game, each in found], pairs)),
    }


def _interval(name: str, mean: Mean) -> Data:
    return {name: mean.value, f"{name}_low": mean.low, f"{name}_high": mean.high, "pairs": mean.pairs}


def _in_order(event: Tournament) -> Iterable[GameResult]:
    """All results in the order of the plan, the attempts of a game one after the other."""
    number = {pair.id: pair.number for pair in event.plan.pairs}
    return sorted(event.results, key=lambda one: (number[one.pair], one.leg, one.attempt))


def _game(result: GameResult, luck: Mapping[Key, GameLuck], replays: Mapping[str, str] = MappingProxyType({})) -> Data:
    """A line of the list of games."""
    found = luck.get((result.pair, result.leg)) if result.counts else None
    more = {"luck": None if found is None else [found.of(0), found.of(1)], "replay": replays.get(result.record)}
    return result.to_dict() | more
