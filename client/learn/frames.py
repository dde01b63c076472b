"""What an environment shows of its game: a line, pixels, or a window by pygame, as Gymnasium's own have one."""

import importlib
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import pictures
from client import notation
from physics import Table, TableState

WIDTH: Final = 640
"""Pixels of a frame."""


def rendered(mode: str | None, state: TableState, table: Table) -> Any:
    """A line in mode `ansi`, pixels (h, w, 3) in mode `rgb_array`, else None."""
    if mode == "ansi":
        return notation.write(state)
    return pixels(state, table) if mode == "rgb_array" else None


def pixels(state: TableState, table: Table) -> NDArray[np.uint8]:
    """(h, WIDTH, 3) red, green, blue."""
    return pictures.pixels(state, table=table, width=WIDTH)


class Window:
    """Opens with the first frame.

    Args:
        seconds: how long a frame stands at least.

    Raises:
        ImportError: pygame is not installed.
    """

    def __init__(self, seconds: float) -> None:
        try:
            self._pygame: Any = importlib.import_module("pygame")
        except ImportError as error:
            raise ImportError("render_mode = 'human': needs pygame (pip install pygame)") from error
        self._rate = 1.0 / seconds
        self._screen: Any = None

    def show(self, pixels: NDArray[np.uint8]) -> None:
        """Show a frame (h, w, 3), when the one before has stood long enough."""
        if self._screen is None:
            self._pygame.display.init()
            self._screen = self._pygame.display.set_mode(pixels.shape[1::-1])
            self._pygame.display.set_caption("Pooliad")
            self._clock = self._pygame.time.Clock()
        self._screen.blit(self._pygame.surfarray.make_surface(pixels.swapaxes(0, 1)), (0, 0))
        self._pygame.event.pump()
        self._pygame.display.flip()
        self._clock.tick(self._rate)

    def close(self) -> None:
        """Close it; a frame shown later opens it again."""
        if self._screen is not None:
            self._pygame.display.quit()
            self._screen = None
