"""The page's scripts as one: what modules do when a browser loads them (ECMA-262, 16.2)."""

import pytest

from server.joined import joined
from server.routes.page import page_files

SCRIPTS = {
    "main": 'import { two, add as plus } from "./sums.js";\nimport { ONE } from "./numbers.js";\n\nplus(ONE, two());\n',
    "sums": 'import { ONE } from "./numbers.js";\n\nconst own = ONE;\nexport function add(a, b) { return a + b; }\n'
    "export async function two() { return add(own, ONE); }\n",
    "numbers": "const own = 1;\nexport const ONE = own;\nexport class Number {}\n",
    "unused": "export const NEVER = 0;\n",
}


def test_what_is_imported_stands_before_and_keeps_its_own_names():
    text = joined(SCRIPTS, "main")
    places = [text.index(f"const of_{name} = (() => {{") for name in ("numbers", "sums", "main")]
    assert places == sorted(places)
    assert text.count("const own = ") == 2  # each in its function
    assert text.count("of_numbers = ") == 1
    assert "const { two, add: plus } = of_sums;" in text
    assert "return { add, two };" in text
    assert "return { ONE, Number };" in text
    assert "NEVER" not in text
    assert "\nexport" not in text
    assert "\nimport" not in text


def test_a_script_that_is_loaded_when_it_is_asked_for_is_there():
    scripts = {"main": 'async () => (await import("./view.js")).VIEW;', "view": "export const VIEW = 1;"}
    assert joined(scripts, "main").endswith("async () => (await of_view).VIEW;\nreturn {  };\n})();")


def test_modules_that_import_each_other_are_refused():
    scripts = {"one": 'import { b } from "./two.js";', "two": 'import { a } from "./one.js";'}
    with pytest.raises(ValueError, match="modules = one -> two -> one: must not import each other in a circle"):
        joined(scripts, "one")


@pytest.mark.parametrize(
    "line",
    ['import "./side.js";', 'import all from "./side.js";', "export default 1;", "export { a };", "export let a = 1;"],
)
def test_other_forms_are_refused(line):
    with pytest.raises(ValueError, match=r"main\.js: .*: must be a named import or export"):
        joined({"main": line, "side": ""}, "main")


def test_the_page_has_every_script_that_it_loads():
    scripts = {name.removesuffix(".js") for name in page_files() if name.endswith(".js")} - {"page"}
    text = page_files()["page.js"].content.decode()
    assert {name for name in scripts if f"const of_{name} = " in text} == scripts
