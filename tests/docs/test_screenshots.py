"""The README's pictures of the page are those of the page as it is; `python -m benchmarks.screenshots` makes them."""

import pytest
from PIL import Image, ImageChops, ImageStat
from support.require import ROOT

from benchmarks import screenshots

COARSE = (55, 36)
"""Pixels to compare: letters and the spread by lot are gone, what is where is left."""
APART = 4.0
"""Of 255, in the mean. Made again they are 1.5 apart at most, by the lot; the laboratory laid out anew was 8 apart."""


@pytest.mark.slow
def test_the_pictures_of_the_page_are_fresh(tmp_path):
    screenshots.main(tmp_path)
    for name in ("page_game.png", "page_laboratory.png"):
        old, new = (Image.open(folder / name).convert("RGB") for folder in (ROOT / "docs", tmp_path))
        assert old.size == new.size
        apart = ImageStat.Stat(
            ImageChops.difference(old.resize(COARSE, Image.Resampling.BOX), new.resize(COARSE, Image.Resampling.BOX))
        ).mean
        assert max(apart) < APART, f"{name}: python -m benchmarks.screenshots"
