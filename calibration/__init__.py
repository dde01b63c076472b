"""Calibration: parameters of a table, and a player's noise, from paths of balls as a camera saw them.

Data become ``Observations`` (``read_paths``), these a ``Calibration`` (``calibrate``): parameters with intervals and
correlations, and which shots the model does not explain. ``compare_laws`` fits several laws to the same data,
``error_model`` estimates how strokes differ from what was intended, ``report`` shows it all.
"""

from calibration.error_model import ErrorModel, error_model
from calibration.errors import InvalidData, InvalidFit
from calibration.fit import calibrate
from calibration.laws import FittedLaw, compare_laws
from calibration.observed import IntendedStroke, Observations, ObservedShot
from calibration.reading import read_paths
from calibration.report import report
from calibration.result import Calibration, ExplainedShot, FittedParameter

__all__ = [
    "Calibration",
    "ErrorModel",
    "ExplainedShot",
    "FittedLaw",
    "FittedParameter",
    "IntendedStroke",
    "InvalidData",
    "InvalidFit",
    "Observations",
    "ObservedShot",
    "calibrate",
    "compare_laws",
    "error_model",
    "read_paths",
    "report",
]
