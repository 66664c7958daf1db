"""A bar, or lines where there is none."""

from __future__ import annotations

import sys
from typing import Any, Iterator


def shown(rows: Iterator[dict[str, Any]], total: int, link: str, wanted: bool) -> Iterator[dict[str, Any]]:
    """The rows, counted on standard error if wanted."""
    if not wanted:
        yield from rows
        return
    print(f"{total} meshes to do; dashboard: {link}", file=sys.stderr)
    try:
        from tqdm import tqdm
    except ImportError:
        yield from _counted(rows, total)
        return
    failed = 0
    with tqdm(rows, total=total, unit="mesh") as bar:
        for row in bar:
            failed += row["status"] != "done"
            bar.set_postfix(failed=failed, refresh=False)
            yield row


def _counted(rows: Iterator[dict[str, Any]], total: int) -> Iterator[dict[str, Any]]:
    for count, row in enumerate(rows, 1):
        if row["status"] != "done":
            print(f"{row['mesh']}: {row['message']}", file=sys.stderr)
        if count % max(1, total // 100) == 0:
            print(f"{count} of {total}", file=sys.stderr)
        yield row
