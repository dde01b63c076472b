"""Writes the tables of the documents from data lines: ``python -m benchmarks.report``.

A table in a document stands between ``<!-- table NAME TITLE [COLUMN ...] -->`` and ``<!-- end -->``; it is taken from
the line to cite (the latest full run, else the latest) and says which line that is.
"""

import re
from pathlib import Path
from typing import Any

from benchmarks import recording

DOCUMENT = recording.ROOT / "docs" / "benchmarks.md"
"""It has a table of every benchmark."""
TABLE = re.compile(r"(<!-- table (\w+) (\w+)((?: \w+)*) -->\n).*?(<!-- end -->)", re.DOTALL)


def write(path: Path) -> None:
    """Put the latest tables into a document."""
    path.write_text(TABLE.sub(filled, path.read_text(encoding="utf-8")), encoding="utf-8")


def filled(match: re.Match[str]) -> str:
    """A marked place with its table."""
    start, name, title, columns, end = match.groups()
    line = recording.best_line(name, title)
    if line is None:
        return f"{start}\nNot measured yet.\n{end}"
    return f"{start}\n{as_markdown(line['tables'][title], columns.split())}\n{cited(line)}\n{end}"


def as_markdown(rows: list[recording.Row], columns: list[str]) -> str:
    """Rows as a table, all columns unless some are named."""
    shown = columns or (list(rows[0]) if rows else [])
    lines = [shown, ["---", *["---:"] * (len(shown) - 1)]]
    lines += [[recording.show(row[column]) for column in shown] for row in rows]
    return "\n".join("| " + " | ".join(text.replace("_", " ") for text in line) + " |" for line in lines) + "\n"


def cited(line: dict[str, Any]) -> str:
    """Where a table's figures come from."""
    machine = line["machine"]
    size = "full run" if line["full"] else "short run"
    changed = ", with changes not committed" if line["uncommitted"] else ""
    return (
        f"*`benchmarks/results/{line['benchmark']}.jsonl`, line `{line['id']}`: {size}, "
        f"commit `{line['commit']}`{changed}, kernels `{line['kernels'][:8]}`, "
        f"{machine['processor']}, {machine['cores']} cores, load {line['load_before']} before.*"
    )


if __name__ == "__main__":
    write(DOCUMENT)
