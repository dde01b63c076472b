"""Three stories of balls that lie touching and creep, found by a million hostile shots.

Rows on extreme cloths sank 1e-10 m into each other: what still closed after step 3 of the contact rule, by up to
1e-9 m/s, was left. And a lattice never settled: parting a ball that creeps turned its friction, the pair was pressed
harder than before, and each of 10,000 rounds came 1e-10 m/s nearer (docs/physics.md, eq. 30). And a ball in a corner,
at 5e-12 m/s, was pushed anew by its neighbour every 2e-13 s, whenever it began to roll: a million events in 60 ms.
"""

import itertools
import math

import pytest

import physics

CREEPING = physics.Table.olympiad().replace(
    mu_slide=0.01,
    mu_roll=0.01,
    mu_spin=0.001,
    mu_ball=0.0,
    e_ball=0.8,
    cushion_parallel=0.0,
    cushion_perpendicular=0.0,
    cushion_spin=0.0,
    cue_test=False,
)
STICKY = CREEPING.replace(mu_slide=1.0, mu_roll=1.0, cushion_perpendicular=1.0)
ROW_NORTH = {11: 0.661810045775182, 0: 0.7189600457851819, 7: 0.776110045785183, 14: 0.833260045785183}
ROW_NORTH |= {3: 0.890410046785183, 5: 0.947560046785183, 15: 1.004710046785283, 10: 0.604660045775181}
STICKY_ROW = {10: 0.6657806308043224, 9: 0.7239306308043223, 0: 0.7810806308143223, 2: 0.8382306308243223}
STICKY_ROW |= {6: 0.8953806308343223, 13: 0.9535306308343222, 5: 1.0106806308353222, 3: 1.0678306308353223}


@pytest.mark.parametrize(
    ("table", "x", "row", "shot"),
    [
        (CREEPING, 0.19023233049865176, ROW_NORTH, physics.Shot(10.0, -90.0, 70.0, 0.0, 0.0)),
        (STICKY, 0.7466588593508932, STICKY_ROW, physics.Shot(10.0, 630.0, 0.0, -5.249e-15, -28.57499999999997)),
    ],
)
def test_they_do_not_sink_into_each_other(table, x, row, shot):
    start = physics.TableState.from_positions({ball: (x, y) for ball, y in row.items()})
    result = physics.simulate(table, start, shot)
    assert result.status is physics.Status.AT_REST
    order = sorted(row, key=row.__getitem__)
    times = [event.time for event in result.events[:: max(1, len(result.events) // 400)]]
    for time in times:
        places = result.at(time).positions
        pairs = [(i, j) for i, j in itertools.pairwise(order) if not math.isnan(places[i, 0] + places[j, 0])]
        assert all(math.dist(places[i], places[j]) > 2 * table.ball_radius - 1e-12 for i, j in pairs)


def test_a_lattice_settles():
    places = {
        0: (0.6561052258226678, 0.7027841906960584),
        1: (0.5471692243459323, 0.8076450751204265),
        3: (0.5731017691912226, 0.756717424302359),
        4: (0.5990343140365129, 0.7057897734842915),
        5: (0.6872435927635325, 0.7507062587258927),
        6: (0.6249668588818031, 0.654862122666224),
        8: (0.635378503072952, 0.8525615603620276),
        11: (0.6613110479182422, 0.8016339095439601),
        12: (0.6924494148591069, 0.8495559775737944),
        13: (0.6301726809773776, 0.7537118415141258),
        14: (0.578307591286797, 0.8555671431502607),
        15: (0.5212366795006421, 0.8585727259384939),
    }
    shot = physics.Shot(0.25236080831059793, 270.0, 26.602467420610303, -5.346310191222847, -1.4906344014985073)
    table = physics.Table.olympiad().replace(cue_test=False)
    result = physics.simulate(table, physics.TableState.from_positions(places), shot)
    assert result.status is physics.Status.AT_REST


def test_a_ball_that_hardly_moves_lies_still():
    row = {10: 0.09375, 5: 0.150900000000001, 0: 0.208050000000001, 7: 0.265200000010001, 9: 0.322350000012001}
    start = physics.TableState.from_positions({ball: (x, 0.4375) for ball, x in row.items()})
    shot = physics.Shot(10.0, -360.0, 70.0, -8.660254037844387e-10, 4.999999999999999e-10)
    result = physics.simulate(physics.Table.olympiad().replace(cue_test=False), start, shot, trace=False)
    assert result.status is physics.Status.AT_REST
    assert result.n_events < 100_000
