"""Importing the referee is light: kernels and the wire load when they are used."""

import subprocess
import sys

import referee

PUBLIC = {
    "RULES",
    "SAFETY",
    "Action",
    "BudgetSpent",
    "Call",
    "Clocks",
    "CueBallArea",
    "Decision",
    "EightBall",
    "EndReason",
    "Evidence",
    "Game",
    "GameSeeds",
    "Group",
    "InvalidAction",
    "InvalidGame",
    "Legal",
    "Limits",
    "MatchSeed",
    "NoiseModel",
    "Outcome",
    "Phase",
    "RefereeError",
    "Refusal",
    "Refused",
    "RuleId",
    "Ruling",
    "SimulationBudget",
    "Stroke",
    "play_stroke",
    "start_game",
}


def test_import_loads_no_numba_scipy_or_pydantic():
    code = "import sys, referee; print(*sorted({name.split('.')[0] for name in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "referee" in loaded
    assert not {"numba", "llvmlite", "scipy", "pydantic", "fastapi", "sqlalchemy"} & set(loaded)


def test_public_surface():
    """Names leave or join it on purpose only."""
    assert set(referee.__all__) == PUBLIC
    assert all(getattr(referee, name) is not None for name in PUBLIC)
