"""The study behind the break of `search`: many breaks on many racks under noise, ruled on and valued.

Successive halving over random breaks: the cue ball's place in the kitchen, speed, aim beside the apex ball, tip.
A break is worth what the table after it is worth to the breaker, by the agent's own values. The winner at each level of
noise is copied into `client/agents/search/breaks.py`, which cites the data line.
"""

import dataclasses

import numpy as np
from numpy.typing import NDArray

import physics
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client.agents.search.breaks import Break, best_break, worth_of_breaking
from client.agents.search.sight import Sight
from client.agents.search.value import Values
from physics import Table
from physics.shot import FIELDS
from referee import Action, CueBallArea, Decision, EightBall, Game, Phase, RuleId, Ruling
from referee.play.noise import OLYMPIAD_SIGMAS

SEED = 20
LEVELS = (0.5, 1.0, 2.0, 5.0)
ROUNDS = ((400, 40), (80, 100), (16, 500), (5, 2000))
"""Breaks kept, and how many racks and draws each is played on; a short run has a tenth of the breaks and leaves
the last round out."""
NEIGHBOURS, STEPS = 4, (0.015, 0.01, 0.25, 1.2, 1.0, 1.0)
"""After the first round the best get neighbours, so far away: m, m, m/s, mm, mm, mm."""
LEAST_BEHIND = 0.002
"""m behind the head string."""
INSIDE = 1e-4
"""m between a cue ball and a cushion, so that rounding cannot put it outside."""
TABLES = ("olympiad", "nine_foot")
WITHIN_FRICTION = 0.75
"""Of the tip offsets that are tried elsewhere: further out a tip slips on tables with jaws, noise included."""


def measure(full: bool) -> Tables:
    """The best breaks of each level, and the one that is played now."""
    rounds = ROUNDS if full else tuple((max(2, kept // 10), racks) for kept, racks in ROUNDS[:-1])
    referees = {name: EightBall(physics.Table.named(name)) for name in TABLES}
    return {
        f"{name.replace('olympiad', '')}_noise_{level:g}".lstrip("_"): study(rules, level, rounds)
        for name, rules in referees.items()
        for level in LEVELS
    }


def study(rules: EightBall, level: float, rounds: tuple[tuple[int, int], ...]) -> list[Row]:
    """The best breaks under one level of noise, the best first."""
    chance = np.random.default_rng(SEED)
    breaks = [best_break(level, rules.table), *(random_break(rules.table, chance) for _ in range(rounds[0][0] - 1))]
    rows: list[Row] = []
    for number, (kept, racks) in enumerate(rounds):
        breaks = breaks[:kept]
        if number == 1:
            breaks += [near(rules.table, one, chance) for one in breaks[: kept // 4] for _ in range(NEIGHBOURS)]
        games = [rules.new_game(1000 * number + rack) for rack in range(min(racks, 500))]
        rows = [row(rules, one, level, games, racks, number) for one in breaks]
        order = sorted(range(len(rows)), key=lambda index: -float(rows[index]["worth"]))
        breaks, rows = [breaks[index] for index in order], [rows[index] for index in order]
    return rows


def random_break(table: Table, chance: np.random.Generator) -> Break:
    """A break from anywhere in the kitchen, hard, at the apex ball or beside it."""
    radius, share = table.ball_radius, WITHIN_FRICTION if table.has_jaws else 1.0
    return Break(
        x=round(float(chance.uniform(radius, 0.5 * table.width)), 4),
        y=round(float(chance.uniform(table.head_string + LEAST_BEHIND, table.head_string + 0.25)), 4),
        v=round(float(chance.choice([table.v_max, chance.uniform(5.0, table.v_max)])), 2),
        aim=round(float(chance.normal(0.0, 16.0)), 2),
        a=round(share * float(chance.choice([0.0, chance.uniform(-12.0, 12.0)])), 2),
        b=round(share * float(chance.uniform(-14.0, 14.0)), 2),
    )


def near(table: Table, one: Break, chance: np.random.Generator) -> Break:
    """A break much like this one."""
    x, y, v, aim, a, b = (
        value + step * float(chance.normal()) for value, step in zip(dataclasses.astuple(one), STEPS, strict=True)
    )
    x = float(np.clip(x, table.ball_radius + INSIDE, table.width - table.ball_radius - INSIDE))
    y, v = max(y, table.head_string + LEAST_BEHIND), min(v, table.v_max)
    return Break(round(x, 4), round(y, 4), round(v, 2), round(aim, 2), round(a, 2), round(b, 2))


def row(rules: EightBall, one: Break, level: float, games: list[Game], copies: int, number: int) -> Row:
    """How one break does on these racks."""
    chance = np.random.default_rng([SEED, number])
    rulings = [
        ruling for game in games for ruling in broken(rules, one, level, game, max(1, copies // len(games)), chance)
    ]
    worths = worth(rules, level, rulings)
    fouled = [bool(ruling.fouls) for ruling in rulings]
    return {
        **dataclasses.asdict(one),
        "breaks": len(rulings),
        "worth": round(float(np.mean(worths)), 4),
        "error": round(float(np.std(worths) / len(worths) ** 0.5), 4),
        "goes_on": round(float(np.mean([each.game.turn == 0 and not each.fouls for each in rulings])), 4),
        "fouls": round(float(np.mean(fouled)), 4),
        "illegal": round(float(np.mean([each.game.choice in (RuleId.R12, RuleId.R12a) for each in rulings])), 4),
        "eight_down": round(float(np.mean([each.game.choice in (RuleId.R13, RuleId.R14) for each in rulings])), 4),
    }


def broken(
    rules: EightBall, one: Break, level: float, game: Game, copies: int, chance: np.random.Generator
) -> list[Ruling]:
    """The rulings on a break played so often on one rack."""
    state = game.state.moved(0, one.place)
    shot = one.stroke(rules.table, state)
    strokes = np.array([[getattr(shot, name) for name in FIELDS]] * (copies if level > 0.0 else 1))
    strokes = strokes + level * OLYMPIAD_SIGMAS.row() * chance.standard_normal(strokes.shape)
    strokes[:, 0], strokes[:, 2] = (
        np.clip(strokes[:, 0], 0.0, rules.table.v_max),
        np.clip(strokes[:, 2], 0.0, rules.table.theta_max),
    )
    batch = physics.simulate_batch(rules.table, state, strokes)
    return rules.apply_batch(game, [Action(shot=shot, cue_ball=one.place)] * len(strokes), batch)


def worth(rules: EightBall, level: float, rulings: list[Ruling]) -> NDArray[np.float64]:
    """What each break leaves its player, seat 0; a choice is worth its best answer to whoever decides."""
    answers = [answered(rules, level, ruling.game) for ruling in rulings]
    known = iter(to_breaker(rules, level, [one for each in answers for one in each if isinstance(one, Game)]))
    worths = [[next(known) if isinstance(one, Game) else one for one in each] for each in answers]
    return np.array(
        [max(each) if ruling.game.turn == 0 else min(each) for each, ruling in zip(worths, rulings, strict=True)]
    )


def answered(rules: EightBall, level: float, game: Game) -> list[Game | float]:
    """The tables that may come of a break, one for each decision; of a new rack what it is worth to seat 0."""
    if game.phase is not Phase.DECISION:
        return [game]
    return [decided(rules, level, game, each) for each in game.decisions]


def decided(rules: EightBall, level: float, game: Game, decision: Decision) -> Game | float:
    """The table when the player in turn decides so; the worth of a new rack to seat 0."""
    ruling = rules.apply(game, Action(decision=decision), None, None)
    if ruling.rerack:
        breaking = worth_of_breaking(rules.table, level)
        return breaking if ruling.game.turn == 0 else 1.0 - breaking
    return ruling.game


def to_breaker(rules: EightBall, level: float, games: list[Game]) -> list[float]:
    """The worth to seat 0 of tables somebody shoots from."""
    if not games:
        return []
    values = Values(Sight(rules.table, level), level)
    positions, nobody = np.array([game.state.positions for game in games]), np.full(len(games), -1, np.int8)
    hand = np.array([game.cue_ball_in_hand is not None for game in games])
    kitchen = np.array([game.cue_ball_in_hand is CueBallArea.KITCHEN for game in games])
    anywhere, behind = (values.to_shoot(positions, nobody, hand, least) for least in (0.0, rules.table.head_string))
    shooter = np.where(kitchen, behind, anywhere)
    mine = np.array([game.turn == 0 for game in games])
    found: list[float] = np.where(mine, shooter, 1.0 - shooter).tolist()
    return found


if __name__ == "__main__":
    main("search_breaks", measure)
