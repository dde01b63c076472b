"""The code blocks of the documentation, by page, in order."""

from pathlib import Path

from support.require import ROOT
from sybil import Document, Example, Sybil
from sybil.parsers.markdown import CodeBlockParser, PythonCodeBlockParser

PAGES = {str(path.relative_to(ROOT)): path for path in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]}
"""Path from the root to file."""


def document(path: Path) -> Document:
    """A page with its Python blocks; they share the document's namespace."""
    return Sybil([PythonCodeBlockParser()]).parse(path)


def python_blocks(path: Path) -> list[Example]:
    """The Python blocks of a page."""
    return list(document(path).examples())


def bash_blocks(path: Path) -> list[str]:
    """The bash blocks of a page, as text."""
    found: list[str] = []

    def keep(example: Example) -> None:
        found.append(example.parsed)

    for example in Sybil([CodeBlockParser("bash", keep)]).parse(path).examples():
        example.evaluate()
    return found
