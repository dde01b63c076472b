"""A digest of what source files say, whatever their comments, docstrings, layout and folders, and whatever reads them.

Tokens would not do: Python 3.12 splits f-strings into tokens where 3.11 has one. The syntax tree is the same on every
version if two things are left out: positions, and fields that are empty (later versions add such). It is written here
by hand because ``ast.dump`` is written differently by different versions.

A file's name and folder decide nothing, but which of two functions of the same name is imported does. So an import
from a file under the digest counts as what that file says, and re-exports lead to where the thing is made: files
can be moved, and packages can re-export, without another digest. A file that is split or a name that is changed
makes another one.
"""

import ast
import hashlib
from collections.abc import Container, Mapping
from dataclasses import dataclass
from typing import Any, Final, Self

_ROUNDS: Final = 3
"""How many imports deep two files are told apart that say the same but for what they import."""


def digest_of_sources(sources: Mapping[str, bytes]) -> str:
    """SHA-256 (hex) of what these files say.

    Args:
        sources: files by the name of their module, a package's own file by that of the package.

    Raises:
        SyntaxError: one is no Python, or newer Python than the one that is running.
    """
    modules = {name: _Module.read(source, sources) for name, source in sources.items()}
    marks = {name: _sha256(module.says) for name, module in modules.items()}
    for _ in range(_ROUNDS):
        marks = {name: _mark(module, modules, marks) for name, module in modules.items()}
    return _sha256("\n".join(sorted(marks[name] for name, module in modules.items() if module.says)))


@dataclass(frozen=True, slots=True)
class _Import:
    """A name that a file has from another under the digest.

    Attributes:
        local: what it is called in the file.
        module: the other file. name: in it; None for the module itself.
    """

    local: str
    module: str
    name: str | None

    @classmethod
    def of(cls, node: ast.stmt, known: Container[str]) -> list[Self]:
        """The imports of a statement, none if it is not one from a known module."""
        if not isinstance(node, ast.ImportFrom) or node.level or node.module is None or node.module not in known:
            return []
        return [cls._named(node.module, alias, known) for alias in node.names]

    @classmethod
    def _named(cls, module: str, alias: ast.alias, known: Container[str]) -> Self:
        local, submodule = alias.asname or alias.name, f"{module}.{alias.name}"
        return cls(local, submodule, None) if submodule in known else cls(local, module, alias.name)


@dataclass(frozen=True, slots=True)
class _Module:
    """A file.

    Attributes:
        says: its tree in words, imports from other files under the digest left out.
        imports: those.
    """

    says: str
    imports: tuple[_Import, ...]

    @classmethod
    def read(cls, source: bytes, known: Container[str]) -> Self:
        writer = _Writer(known)
        writer.statements(ast.parse(source).body)
        return cls(" ".join(writer.parts), tuple(writer.imports))

    def passes_on(self, name: str) -> _Import | None:
        """The import a name of this file comes from."""
        return next((found for found in self.imports if found.local == name), None)


def _mark(module: _Module, modules: Mapping[str, _Module], marks: Mapping[str, str]) -> str:
    """What a file says, and what those say that it imports from."""
    found = [(each.local, _home(each, modules)) for each in module.imports]
    lines = {f"{local}={marks[home.module]}.{home.name}" for local, home in found}
    return _sha256("\n".join([_sha256(module.says), *sorted(lines)]))


def _home(found: _Import, modules: Mapping[str, _Module]) -> _Import:
    """The import from the module where the name is made, followed through those that only pass it on."""
    for _ in modules:  # no path is longer
        further = None if found.name is None else modules[found.module].passes_on(found.name)
        if further is None:
            break
        found = further
    return found


class _Writer:
    """Writes a tree as text that is the same on every version of Python; imports from known files are put aside."""

    def __init__(self, known: Container[str]) -> None:
        self._known = known
        self.imports: list[_Import] = []
        self.parts: list[str] = []

    def statements(self, body: list[Any]) -> None:
        """Write statements that do something."""
        for node in body:
            imports = _Import.of(node, self._known)
            self.imports += imports
            if not (imports or _does_nothing(node)):
                self._node(node)

    def _node(self, node: ast.AST) -> None:
        if isinstance(node, ast.Constant):
            self.parts.append(ascii(node.value))  # repr() leaves letters as they are that this version's Unicode knows
            return
        self.parts.append(f"({type(node).__name__}")
        for name in sorted(node._fields):
            value = getattr(node, name, None)
            if value is not None and value != [] and name != "ctx":  # read or written: the place in the tree says so
                self.parts.append(f"{name}=")
                self._value(_joined(value) if isinstance(node, ast.JoinedStr) else value)
        self.parts.append(")")

    def _value(self, value: Any) -> None:
        if isinstance(value, ast.AST):
            self._node(value)
        elif not isinstance(value, list):
            self.parts.append(ascii(value))
        else:
            self.parts.append("[")
            if value and isinstance(value[0], ast.stmt):
                self.statements(value)
            else:
                for each in value:
                    self._value(each)
            self.parts.append("]")


def _does_nothing(node: ast.stmt) -> bool:
    """Docstrings, those below assignments too; ``pass``; the list of what ``import *`` takes."""
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
    if isinstance(node, ast.Assign):
        return [target.id for target in node.targets if isinstance(target, ast.Name)] == ["__all__"]
    return isinstance(node, ast.Pass)


def _joined(values: list[ast.expr]) -> list[ast.expr]:
    """Parts of an f-string, its plain text in one piece between two fields: versions cut it differently."""
    parts: list[ast.expr] = []
    for value in values:
        text = value.value if isinstance(value, ast.Constant) else None
        last = parts[-1] if parts else None
        if isinstance(text, str) and isinstance(last, ast.Constant) and isinstance(last.value, str):
            parts[-1] = ast.Constant(last.value + text)
        elif text != "":
            parts.append(value)
    return parts


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
