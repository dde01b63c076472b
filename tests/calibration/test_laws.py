"""Cushion laws told apart by the same data: Han (2005) and Mathavan et al. (2010), on a nine-foot table."""

import numpy as np
import pytest

from calibration import InvalidFit
from calibration.laws import compare_laws
from calibration.synthetic import Camera, seen
from physics import Table

CLOTH = Table.nine_foot().replace(flight=False)


@pytest.mark.slow
def test_the_law_that_the_paths_were_made_with_is_the_best_and_the_other_is_not_trusted():
    truth = CLOTH.replace(cushion="mathavan")
    observations = seen(truth, 6, np.random.default_rng(3), Camera(sigma=5e-4, rate=60.0))
    best, other = compare_laws(CLOTH, observations, ["e_cushion", "mu_cushion", "mu_slide"], ["han", "mathavan"])
    assert (best.law, best.followed, best.calibration.is_trusted) == ("mathavan", 1.0, True)
    for one in best.calibration.estimates:
        assert abs(one.value - getattr(truth, one.name)) < 5.0 * one.sigma
    assert (other.law, other.calibration.is_trusted) == ("han", False)
    assert other.worse > 1.0
    assert other.calibration.unexplained


def test_a_law_that_the_table_does_not_have_is_refused():
    observations = seen(CLOTH, 1, np.random.default_rng(3))
    with pytest.raises(InvalidFit, match="cushion = 'hertz'"):
        compare_laws(CLOTH, observations, ["e_cushion"], ["hertz"])
