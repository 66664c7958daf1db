"""Thousands of meshes on Dask.

    import mspskel.batch
    table = mspskel.batch.map("meshes", "skeletons")

One task a mesh, each in a process of its own with a limit of time and of memory. Results are whole or not there; what fails is a
row that says why; what is done and unchanged is not done again.
"""

from __future__ import annotations

import os
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any, Iterable, Sequence

from ..options import Options, merged
from .job import Job, read_record
from .jobs import find_meshes, make_jobs
from .scheduler import answers, connected
from .show import shown
from .table import make_table, write_table

if TYPE_CHECKING:
    import pandas
    from distributed import Client

__all__ = ["Job", "find_meshes", "map"]


def map(
    meshes: str | os.PathLike | Iterable[str | os.PathLike],
    out: str | os.PathLike,
    *,
    client: Client | None = None,
    scheduler: str | None = None,
    workers: int | None = None,
    pattern: str | None = None,
    root: str | os.PathLike | None = None,
    formats: Sequence[str] = (".skel",),
    checks: bool = True,
    time_limit: float = 600,
    memory_limit: int = 0,
    retry_failed: bool = False,
    progress: bool = False,
    work: str = Job.work,
    options: Options | None = None,
    **keywords: Any,
) -> pandas.DataFrame:
    """Makes the skeletons of many meshes, and OUT/table.csv and OUT/table.parquet with a row for each.

    meshes        paths, or a folder, in which `pattern` picks files
    out           folder; the skeleton of a/b.off is a/b.off.skel there
    client        of a Dask cluster that runs; else `scheduler` is one's address, else `workers` are started here
    checks        measure coverage too
    time_limit    seconds a mesh, 0 for none
    memory_limit  bytes of address space a mesh, 0 for none
    retry_failed  do again what failed before
    options       as for skeletonize, and so are keywords; one thread a mesh unless they say otherwise

    Workers need the same paths and this package. A mesh is done again if its size, its time of change, the options or the
    package's version changed. Returns the table. Raises UsageError before the work, ConnectionError if the scheduler is lost.
    """
    listed = find_meshes(meshes, pattern, out) if isinstance(meshes, (str, os.PathLike)) else meshes
    base = meshes if root is None and isinstance(meshes, (str, os.PathLike)) else root
    settings = dict(formats=tuple(formats), options=merged(options, keywords).given, checks=checks, work=work)
    jobs = make_jobs(listed, out, base, **settings, time_limit=time_limit, memory_limit=memory_limit)
    known = [(job, read_record(job)) for job in jobs]
    rows = [row for _, row in known if row and (row["status"] == "done" or not retry_failed)]
    todo = [job for job, row in known if not row or (row["status"] != "done" and retry_failed)]
    try:
        if todo:
            with nullcontext(client) if client is not None else connected(scheduler, workers) as cluster:
                for row in shown(answers(cluster, todo), len(todo), cluster.dashboard_link, progress):
                    rows.append(row)
    finally:
        table = make_table(rows)
        write_table(table, os.fspath(out))
    return table
