"""Pictures of tables, positions and shots: SVG as text, PNG, and replays as one HTML file.

Everything is drawn to scale, a millimetre of the table as one unit of the picture. A picture needs no font, no network
and no second file, and two on one page do not disturb each other. ``svg`` and ``html`` need nothing but the physics;
``png`` needs the extra ``pictures``.
"""

from pictures.picture import described, pixels, png, svg
from pictures.replay import ReplayShot, html
from pictures.theme import THEMES

__all__ = ["THEMES", "ReplayShot", "described", "html", "pixels", "png", "svg"]
