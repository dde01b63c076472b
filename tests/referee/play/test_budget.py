"""docs/protocol.md, the simulation budget: a number of simulated shots, exact, refused whole beyond it."""

from concurrent.futures import ThreadPoolExecutor

import pytest

from referee import BudgetSpent, SimulationBudget


def test_the_last_shot_may_be_simulated_and_none_after_it():
    budget = SimulationBudget(3)
    budget.spend(2)
    budget.spend(1)
    assert budget.remaining == 0
    with pytest.raises(BudgetSpent, match=r"simulations = 1: at most 0 are left"):
        budget.spend(1)


def test_a_batch_that_does_not_fit_is_refused_whole():
    budget = SimulationBudget(10)
    with pytest.raises(BudgetSpent, match="at most 10"):
        budget.spend(11)
    assert (budget.used, budget.remaining) == (0, 10)


def test_without_a_number_everything_is_counted_and_nothing_refused():
    budget = SimulationBudget()
    budget.spend(10**6)
    assert (budget.used, budget.remaining) == (10**6, None)


@pytest.mark.parametrize("allowed", [-1, 1.5, True, "3"])
def test_a_budget_is_a_whole_number(allowed):
    with pytest.raises(ValueError, match="allowed"):
        SimulationBudget(allowed)


def test_threads_share_a_budget_without_losing_count():
    budget = SimulationBudget(1000)

    def spend(_):
        try:
            budget.spend(7)
        except BudgetSpent:
            return 0
        return 7

    with ThreadPoolExecutor(8) as pool:
        assert sum(pool.map(spend, range(200))) == budget.used == 994
