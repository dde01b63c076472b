"""What importing tournaments loads: results are also read where nobody asks for statistics."""

import subprocess
import sys


def test_scipy_is_loaded_by_the_first_question_only():
    program = (
        "import sys, tournament, tournament.report, tournament.luck; before = 'scipy' in sys.modules;"
        "from tournament.statistics import score_of_cells; score_of_cells((0, 0, 0, 0, 100));"
        "print(before, 'scipy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "True"]
