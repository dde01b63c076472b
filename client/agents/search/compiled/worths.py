"""What a position is worth: the race to the 8 between what both groups offer."""

from client.agents.search import shots as at
from client.agents.search.compiled.compiling import compiled, inner
from client.agents.search.compiled.fans import Layout
from client.agents.search.compiled.resting import remember
from client.agents.search.compiled.surveying import Task, survey_group


@inner
def looked_up(values, row, column):
    """A table's value between its entries, bilinear; beyond its edges the edge's."""
    most = values.shape[0] - 1
    row, column = min(max(row, 0.0), float(most)), min(max(column, 0.0), float(most))
    i, j = min(int(row), most - 1), min(int(column), most - 1)
    s, t = row - i, column - j
    low = (1.0 - t) * values[i, j] + t * values[i, j + 1]
    high = (1.0 - t) * values[i + 1, j] + t * values[i + 1, j + 1]
    return (1.0 - s) * low + s * high


@compiled
def shooter(race, needs, other, chance, seen):
    """The shooter's chance to win the game.

    Args:
        race: (4, m, m), the values of `client.agents.search.race.Race`.
        needs, other: perfect balls that the shooter and the opponent need, >= 0, the 8 included.
        chance: of the shooter's best pot. seen: whether any ball can be struck straight.
    """
    made, missed = looked_up(race[at.MADE], needs - 1.0, other), looked_up(race[at.MISSED], needs, other)
    safe = looked_up(race[at.SAFE] if seen else race[at.HIDDEN], needs, other)
    return max(chance * made + (1.0 - chance) * missed, safe)


@compiled
def worths(table, before, positions, shooters, terms, race, memory, out):
    """What each position is worth to its shooter.

    Args:
        before: (n, 16, 2) m, where balls lay before the stroke that led there: rows alike cost less.
        shooters: (group, hand), each (n,): the group that shoots, -1 on an open table (the better one then), and
            whether the cue ball is in hand.
        terms: (sigma, kitchen, perfect, pots): as for `survey`; what a layout's hardness is divided by to count as
            balls; whether pots count, or nothing but safeties.
        race: as for `shooter`. memory: `new_memory`. out: (n,), filled.
    """
    group, hand = shooters
    sigma, kitchen, perfect, pots = terms
    offers, needs = memory.offers, memory.needs
    for n in range(positions.shape[0]):
        view = Layout(table, positions[n])
        remember(table, memory, before[n], positions[n], sigma)
        for g in range(2):
            mine = group[n] == -1 or group[n] == g
            left = survey_group(view, memory, g, sigma, Task(mine, mine and hand[n], kitchen), offers[g])
            needs[g] = left + offers[g, at.LAYOUT] / perfect
        best = 0.0
        for g in range(2):
            if group[n] == -1 or group[n] == g:
                chance = (offers[g, at.PLACED] if hand[n] else offers[g, at.CHANCE]) if pots else 0.0
                seen = hand[n] or offers[g, at.SEEN] > 0.0
                best = max(best, shooter(race, needs[g], needs[1 - g], chance, seen))
        out[n] = best
