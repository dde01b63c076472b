"""What axe-core finds on a page: WCAG 2.2 AA and best practice."""

from importlib.util import find_spec
from pathlib import Path
from typing import Any

from support.require import require

RULES = {"runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]}


def violations(page: Any) -> list[str]:
    """In the page's own world, by the debugger: the policy lets no script in otherwise."""
    spec = find_spec("axe_playwright_python")
    require(spec is not None, "axe-playwright-python, of the test extra")
    assert spec is not None
    assert spec.origin is not None
    page.evaluate((Path(spec.origin).parent / "axe.min.js").read_text())
    result = page.evaluate("rules => axe.run(document, rules)", RULES)
    return [f"{one['id']}: {[node['html'] for node in one['nodes']]}" for one in result["violations"]]
