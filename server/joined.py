"""The page's scripts as one: a browser that asks for fifty modules has its picture later.

A module becomes a function that is called at once and returns what it exports; those that it imports stand before it.
What `server/web` is written in is understood, nothing else: named imports and exports, each beginning a line.
"""

import re
from collections.abc import Mapping
from typing import Final

IMPORT: Final = re.compile(r'^import \{([^}]*)\} from "\./([a-z_]+)\.js";$', re.MULTILINE)
EXPORT: Final = re.compile(r"^export (?=(?:async function|function|class|const) (\w+))", re.MULTILINE)
LATER: Final = re.compile(r'\bimport\("\./([a-z_]+)\.js"\)(?=\))')
LEFT: Final = re.compile(r"^(?:import|export)\b.*", re.MULTILINE)


def joined(scripts: Mapping[str, str], first: str) -> str:
    """One script that does what the module `first` does.

    Args:
        scripts: text of every module by its name, without ".js".
        first: the name of the one that nobody imports.

    Raises:
        ValueError: modules import each other in a circle, or an import or export has another form.
    """
    order: dict[str, str] = {}
    _add(scripts, first, order, ())
    return "\n".join(order.values())


def _add(scripts: Mapping[str, str], name: str, order: dict[str, str], on_the_way: tuple[str, ...]) -> None:
    """Put a module behind those that it needs."""
    if name in on_the_way:
        raise ValueError(f"modules = {' -> '.join((*on_the_way, name))}: must not import each other in a circle")
    if name in order:
        return
    text = scripts[name]
    for needed in (*(found[1] for found in IMPORT.findall(text)), *LATER.findall(text)):
        _add(scripts, needed, order, (*on_the_way, name))
    order[name] = _called(name, text)


def _called(name: str, text: str) -> str:
    """A module as a constant that holds its exports."""
    body = IMPORT.sub(lambda found: f"const {{{found[1].replace(' as ', ': ')}}} = of_{found[2]};", text)
    body = EXPORT.sub("", LATER.sub(r"of_\1", body))
    if strange := LEFT.search(body):
        raise ValueError(f"{name}.js: {strange[0]!r}: must be a named import or export that begins a line")
    exports = ", ".join(EXPORT.findall(text))
    return f"const of_{name} = (() => {{\n{body}\nreturn {{ {exports} }};\n}})();"
