"""The table of a batch, as Parquet and CSV."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from .job import COLUMNS

if TYPE_CHECKING:
    import pandas

COUNTS = ("vertices", "faces", "components", "genus", "nodes", "edges", "cycles", "leaves", "peak_memory")


def make_table(rows: list[dict[str, Any]]) -> pandas.DataFrame:
    """One row a mesh, in order of the meshes; what is not known is missing."""
    import pandas

    table = pandas.DataFrame(sorted(rows, key=lambda row: row["mesh"]), columns=list(COLUMNS))
    kinds = {name: "Int64" for name in COUNTS}
    return table.astype({**kinds, "mended": "boolean"})


def write_table(table: pandas.DataFrame, out: str) -> None:
    """OUT/table.csv and OUT/table.parquet, each whole or not at all."""
    os.makedirs(out, exist_ok=True)
    for name, write in (("table.csv", table.to_csv), ("table.parquet", table.to_parquet)):
        path = os.path.join(out, name)
        write(path + ".part", index=False)
        os.replace(path + ".part", path)
