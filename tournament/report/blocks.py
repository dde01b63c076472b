"""What sections are built of: tables, figures, notes, links. Here every text is escaped.

Every text that comes from outside (names, records, rule ids) passes ``text``; a record becomes a link only if it is a
web address or a plain relative path.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from types import MappingProxyType
from typing import Any
from urllib.parse import quote

_NONE: Mapping[str, str] = MappingProxyType({})
_WEB = re.compile(r"https?://[^\s]+", re.IGNORECASE)
_PATH = re.compile(r"(?!/)(?!.*(?:^|/)\.\.(?:/|$))[\w.,=+@ -]+(?:/[\w.,=+@ -]+)*")


def text(value: Any) -> str:
    """Any value as text of a page, never markup."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return escape(f"{value:.4g}" if isinstance(value, float) else str(value))


def table(
    caption: str, heads: Sequence[str], rows: Iterable[Sequence[Any]], texts: int = 1, says: Mapping[str, str] = _NONE
) -> str:
    """A table; the first ``texts`` columns are texts, the others numbers. Cells are escaped here.

    ``says`` tells below the table what columns mean, those that it has.
    """
    marks = [' class="text"' if index < texts else "" for index in range(len(heads))]
    head = "".join(f'<th scope="col"{mark}>{text(name)}</th>' for mark, name in zip(marks, heads, strict=True))
    body = "".join(_cells(row, marks) for row in rows)
    return (
        f'<div class="wide" tabindex="0"><table><caption>{text(caption)}</caption>'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>{_legend(heads, says)}"
    )


def _legend(heads: Sequence[str], says: Mapping[str, str]) -> str:
    meanings = [(name, meaning) for name, meaning in says.items() if name in heads]
    rows = "".join(f"<div><dt>{text(name)}</dt><dd>{text(meaning)}</dd></div>" for name, meaning in meanings)
    return f'<dl class="says">{rows}</dl>' if rows else ""


def link(address: str, words: str) -> str:
    """A link, as text if it leads neither to a web address nor to a plain relative path; nothing without an address."""
    if _WEB.fullmatch(address):
        return f'<a href="{escape(address)}" rel="noreferrer">{text(words)}</a>'
    if _PATH.fullmatch(address):
        return f'<a href="{escape(quote(address))}">{text(words)}</a>'
    return text(address)


def _cells(row: Sequence[Any], marks: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<td{mark}>{text(cell)}</td>" for mark, cell in zip(marks, row, strict=True)) + "</tr>"


def figure(plot: str, caption: str) -> str:
    """A plot with its caption."""
    return f'<figure tabindex="0">{plot}<figcaption>{text(caption)}</figcaption></figure>'


def beside(*parts: str) -> str:
    """Beside one another where there is room."""
    return f'<div class="beside">{"".join(f"<div>{part}</div>" for part in parts if part)}</div>'


def note(words: str) -> str:
    """A paragraph that explains."""
    return f'<p class="note">{text(words)}</p>'
