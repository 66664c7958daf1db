"""What Dask calls, on a worker, once a mesh."""

from __future__ import annotations

import threading
import time
from typing import Any

from .child import Child
from .job import COLUMNS, Job, write_record

_own = threading.local()


def run_task(job: Job) -> dict[str, Any]:
    """Works on the job in this thread's child process, and notes and returns its row."""
    if not hasattr(_own, "child"):
        _own.child = Child()
    start = time.monotonic()
    row = row_of(job, _own.child.run(job), time.monotonic() - start)
    write_record(job, row)
    return row


def row_of(job: Job, answer: dict[str, Any], seconds: float) -> dict[str, Any]:
    """The row with all columns."""
    row = dict.fromkeys(COLUMNS)
    row.update(mesh=job.mesh, error="", message="", warnings="", outputs="", seconds=round(seconds, 3))
    row.update({name: value for name, value in answer.items() if name in row})
    if row["status"] == "done":
        row["outputs"] = "; ".join(job.outputs())
    return row
