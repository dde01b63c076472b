"""Requests of a page that reach the server when a test says so."""

from typing import Any

from playwright.sync_api import Page


class HeldBack:
    """Those whose address fits a pattern: held until `let_go`, let through from then on."""

    def __init__(self, page: Page, pattern: Any) -> None:
        self._page = page
        self.held: list[Any] | None = []
        page.route(pattern, self._come)

    def _come(self, route: Any) -> None:
        if self.held is None:
            route.continue_()
        else:
            self.held.append(route)

    def wait(self) -> None:
        """Until there is one."""
        while not self.held:
            self._page.wait_for_timeout(20)

    def let_go(self) -> None:
        """All of them."""
        held, self.held = self.held, None
        for route in held or ():
            route.continue_()
