"""A row of six touching balls on the slowest cloth came to EVENT_LIMIT: parted pairs bounced off their neighbours.

With e = 0.8 that made a million events in 45 s, touching every 40 ms. What step 3 of the contact rule sets in
motion now acts plastically (docs/physics.md, "Contacts").
"""

import physics

SLOWEST = physics.Table.olympiad().replace(
    mu_slide=0.01,
    mu_roll=0.001,
    mu_spin=0.001,
    mu_ball=0.0,
    e_ball=0.8,
    cushion_parallel=1.0,
    cushion_perpendicular=1.0,
    cushion_spin=1.0,
    cue_test=False,
)
ROW = {
    0: 0.10005788532803661,
    7: 0.20720788532803658,
    12: 0.2643578853281366,
    5: 0.3215078863281366,
    4: 0.3786588863281366,
    11: 0.4358088863301366,
}


def test_it_comes_to_rest():
    state = physics.TableState.from_positions({ball: (x, 2.1455602848706588) for ball, x in ROW.items()})
    result = physics.simulate(SLOWEST, state, physics.Shot(10.0, -180.0, 70.0, 6.12e-26, 1e-9), trace=False)
    assert result.status is physics.Status.AT_REST
    assert result.n_events < 300_000
