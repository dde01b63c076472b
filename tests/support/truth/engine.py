"""The event loop of the truth engine: next event over all balls and pairs, what it does, and the record."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from mpmath import mp, mpf
from support.truth.contacts import Cluster, make_cluster, resolve, touching
from support.truth.detect import Octagon, boundary_of, own_event, pair_contact
from support.truth.flight import fall
from support.truth.laws import bounce, historical_collision
from support.truth.model import OUT_OF_PLAY, Ball, Motion, World, real
from support.truth.moments import Event
from support.truth.motion import advance, classify, end_of_motion
from support.truth.rails import Rails
from support.truth.strike import Stroke, strike


@dataclass
class Record:
    """One event and the balls it changed, just after it."""

    time: mpf
    kind: str
    ball: int
    other: int = -1
    states: tuple[Ball, ...] = ()


@dataclass
class Shot:
    """A shot under way or finished."""

    world: World
    balls: dict[int, Ball]
    time: mpf = field(default_factory=lambda: mpf(0))
    records: list[Record] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.boundary = boundary_of(self.world)
        self.own: dict[int, Event | None] = {}
        self.pairs: dict[tuple[int, int], Event | None] = {}
        self.predict(self.balls)

    def on_table(self) -> list[Ball]:
        return [ball for ball in self.balls.values() if ball.motion not in OUT_OF_PLAY]

    def predict(self, numbers: Iterable[int]) -> None:
        """Renew what is known about the future of these balls."""
        changed = set(numbers)
        for i in changed:
            self.own[i] = own_event(self.world, self.boundary, self.balls[i], self.time)
        for i, one in self.balls.items():
            for j, two in self.balls.items():
                if i < j and (i in changed or j in changed):
                    here = one.motion not in OUT_OF_PLAY and two.motion not in OUT_OF_PLAY
                    self.pairs[i, j] = pair_contact(self.world, one, two, self.time) if here else None

    def next_event(self) -> Event | None:
        known = [event for event in (*self.own.values(), *self.pairs.values()) if event]
        return min(known, key=Event.key, default=None)

    def cluster_of(self, numbers: Iterable[int]) -> Cluster:
        """The touching cluster of these balls, all moved to the present."""
        here = {ball.number: ball.copy() for ball in self.on_table()}
        for ball in here.values():
            advance(self.world, ball, self.time)
        members = [here[i] for i in numbers if i in here]
        for ball in members:
            members += [b for b in here.values() if b not in members and touching(self.world, ball, b)]
        members.sort(key=lambda ball: ball.number)
        self.balls.update({ball.number: ball for ball in members})
        return make_cluster(self.world, self.boundary, members)

    def record(self, kind: str, ball: int, other: int, changed: Iterable[int]) -> None:
        states = tuple(self.balls[i].copy() for i in sorted(changed))
        self.records.append(Record(self.time, kind, ball, other, states))

    def settle_contacts(self, numbers: Iterable[int], fallback: tuple[str, int, int] | None) -> None:
        """Resolve the cluster of these balls and record what acted; ``fallback`` if nothing did."""
        cluster = self.cluster_of(numbers)
        resolve(cluster)
        changed = [ball.number for ball in cluster.balls]
        for kind, ball, other in cluster.acted or ([fallback] if fallback else []):
            self.record(kind, ball, other, changed)
        self.predict(changed)

    def step(self) -> bool:
        """Process the next event; False when everything rests."""
        event = self.next_event()
        if event is None:
            return False
        self.time = event.time
        involved = [event.ball] + ([event.other] if event.kind == "ball_collision" else [])
        for i in involved:
            advance(self.world, self.balls[i], self.time)
        if event.kind == "pocket_collision":
            self.pocket(event)
        elif event.kind == "off_table":
            self.drive_off(event.ball)
        elif event.kind == "rail_top":
            self.fall_on_rail(event)
        elif event.kind == "transition" and self.balls[event.ball].motion is Motion.FLYING:
            self.land(event)
        elif event.kind == "transition":
            name = end_of_motion(self.world, self.balls[event.ball])
            self.record(name, event.ball, -1, involved)
            self.after_transition(event)
        elif self.world.historical:
            self.historical(event, involved)
        else:
            self.settle_contacts(involved, (event.kind, event.ball, event.other))
        return True

    def after_transition(self, event: Event) -> None:
        if self.world.historical:
            self.predict([event.ball])
        else:
            self.settle_contacts([event.ball], None)

    def pocket(self, event: Event) -> None:
        self.balls[event.ball].motion = Motion.POCKETED
        self.record(event.kind, event.ball, event.other, [event.ball])
        self.predict([event.ball])

    def drive_off(self, number: int) -> None:
        self.balls[number].motion = Motion.DRIVEN_OFF
        self.record("off_table", number, -1, [number])
        self.predict([number])

    def fall_on_rail(self, event: Event) -> None:
        number, world = event.ball, real(self.world)
        ball = self.balls[number]
        ball.height = world.nose_height
        fall(world, ball, world.e_rail, world.mu_rail)
        if ball.rise == 0:
            self.drive_off(number)
            return
        self.record("rail_top", number, event.other, [number])
        self.predict([number])

    def land(self, event: Event) -> None:
        """The flight ends: in a hole, or on the cloth and whatever is touched there."""
        ball = self.balls[event.ball]
        ball.height = mpf(0)
        assert isinstance(self.boundary, Rails)
        pocket = self.boundary.air.over_hole(ball.position)
        if pocket is not None:
            self.pocket(Event(event.time, "pocket_collision", event.ball, pocket))
        else:
            self.settle_contacts([event.ball], None)

    def historical(self, event: Event, involved: list[int]) -> None:
        if event.kind == "ball_collision":
            historical_collision(self.world, self.balls[event.ball], self.balls[event.other])
        else:
            assert isinstance(self.boundary, Octagon)
            bounce(self.world, self.balls[event.ball], self.boundary.sides[event.other])
            classify(self.world, self.balls[event.ball])
        self.record(event.kind, event.ball, event.other, involved)
        self.predict(involved)


def start(world: World, positions: Mapping[int, tuple[float, float]], stroke: Stroke) -> Shot:
    """The shot just after the cue's strike and the contacts it settles."""
    balls = {i: Ball(i, mp.mpc(mpf(float(x)), mpf(float(y)))) for i, (x, y) in sorted(positions.items())}
    shot = Shot(world, balls)
    strike(world, balls[0], stroke)
    shot.record("cue_strike", 0, -1, [0])
    if world.historical:
        shot.predict([0])
    else:
        shot.settle_contacts([0], None)
    return shot


def play(
    positions: Mapping[int, tuple[float, float]],
    stroke: Stroke,
    world: World | None = None,
    *,
    digits: int = 50,
    max_events: int = 10_000,
) -> Shot:
    """Simulate a whole shot, or its first ``max_events`` records, at this many decimal digits."""
    with mp.workdps(digits):
        shot = start(replace(world) if world else World(), positions, stroke)
        while len(shot.records) < max_events and shot.step():
            pass
        return shot
