"""Observations as the CSV that ``read_paths`` reads: paths, and the strokes that were meant."""

import math

from calibration.observed import Observations
from calibration.shot_model import STROKE


def paths_csv(observations: Observations, notes: tuple[str, ...] = ()) -> str:
    """The paths, in millimetres from the corner; ``notes`` are put above them as comments."""
    high = any(not math.isnan(height) for shot in observations.shots for height in shot.heights.tolist())
    lines = [f"# {note}" for note in notes] + ["# length = mm", "# time = s", "# frame = corner"]
    lines += [] if observations.sigma is None else [f"# sigma = {1e3 * observations.sigma:g}"]
    lines += ["# strike = known" if observations.strike_known else "# strike = unknown"]
    lines += ["shot,t,ball,x,y,z" if high else "shot,t,ball,x,y"]
    for shot in observations.shots:
        rows = zip(shot.times.tolist(), shot.balls.tolist(), shot.places.tolist(), shot.heights.tolist(), strict=True)
        for time, ball, (x, y), height in rows:
            seen = f",{1e3 * height:.2f}" if high and not math.isnan(height) else "," if high else ""
            lines.append(f"{shot.name},{time:.6g},{ball},{1e3 * x:.2f},{1e3 * y:.2f}{seen}")
    return "\n".join(lines) + "\n"


def strokes_csv(observations: Observations) -> str:
    """What the players meant; what is not known is left empty."""
    lines = [f"shot,{','.join(STROKE)}"]
    for shot in observations.shots:
        known = [getattr(shot.stroke, name) for name in STROKE]
        lines.append(",".join([shot.name, *("" if value is None else f"{value:.6g}" for value in known)]))
    return "\n".join(lines) + "\n"
