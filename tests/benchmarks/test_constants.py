"""The constants that `benchmarks.constants` varies are there, where it looks for them (docs/physics.md, "Contacts")."""

import importlib

import pytest

from benchmarks import constants
from physics.kernels import tolerances

NOT_OF_THE_RULE = {
    *("STEPS_PER_EVENT", "ROUND_LIMIT"),
    *("DEEPER", "SOLVER_STEPS", "SETTLED_STEPS", "ROOT_RESIDUAL"),
    *("ROUNDING_ACROSS", "GRAZE", "UNFELT"),
    *("LIFT", "PRESS_TIME", "RAIL_CAP", "PERCHED_AFTER"),
}
"""Limits that no shot reaches, what belongs to the solver, what only jaws ask for, and flight's: of these
`benchmarks.flights` says what the choices change."""


@pytest.mark.parametrize(("module", "name", "factors"), constants.VARIED)
def test_it_can_be_varied(module, name, factors):
    value = getattr(importlib.import_module(module), name)
    assert value > 0.0
    assert len({value, *(value * factor for factor in factors)}) == 3


def test_every_constant_of_the_rule_is_varied():
    ours = {name for name in vars(tolerances) if name.isupper()}
    assert ours - NOT_OF_THE_RULE == {name for module, name, _ in constants.VARIED if module == constants.KERNELS}
