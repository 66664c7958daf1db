"""One mesh of a batch: what is to be done, and the record of what was."""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import asdict, dataclass, field
from typing import Any

from .. import _core

#: Columns of the table, in order. Lengths are in the mesh's units, coverage in diagonals of the mesh.
COLUMNS = (
    "mesh", "status", "error", "message", "vertices", "faces", "components", "genus", "mended", "nodes", "edges",
    "cycles", "leaves", "length", "certificate", "inside", "coverage_mean", "coverage_p95", "seconds", "peak_memory",
    "warnings", "outputs",
)  # fmt: skip


@dataclass(frozen=True)
class Job:
    """What a worker needs to know; all of it is plain data."""

    mesh: str  # path
    name: str  # path below the input folder, which names the outputs
    out: str  # folder
    formats: tuple[str, ...] = (".skel",)
    options: dict[str, Any] = field(default_factory=dict)
    checks: bool = True
    time_limit: float = 0  # seconds; 0: none
    memory_limit: int = 0  # bytes of address space; 0: none
    work: str = "mspskel.batch.work:skeletonize_job"  # module:function that takes the job and returns a row

    def outputs(self) -> list[str]:
        """The files that are made."""
        return [os.path.join(self.out, self.name + suffix) for suffix in self.formats]

    def record_path(self) -> str:
        """Where the record is; in one of 256 folders, so that none grows too large."""
        key = hashlib.sha1(self.name.encode()).hexdigest()
        return os.path.join(self.out, ".mspskel", key[:2], key[2:] + ".json")

    def state(self) -> dict[str, Any]:
        """What the results depend on; a record with another state is out of date. Raises OSError."""
        status = os.stat(self.mesh)
        wanted = {k: v for k, v in asdict(self).items() if k in ("formats", "options", "checks", "work")}
        return {"version": _core.version, "size": status.st_size, "mtime_ns": status.st_mtime_ns, **wanted}


def write_record(job: Job, row: dict[str, Any]) -> None:
    """Notes the row, whole or not at all."""
    try:
        state = job.state()
    except OSError:
        state = {}
    path = job.record_path()
    os.makedirs(os.path.dirname(path), exist_ok=True)
    _core.write_file(path, json.dumps({"state": state, "row": row}).encode())


def read_record(job: Job) -> dict[str, Any] | None:
    """The row of a job that is done and unchanged, outputs and all; None if it is to be done."""
    try:
        with open(job.record_path(), encoding="utf-8") as file:
            record = json.load(file)
        same = record["state"] == json.loads(json.dumps(job.state()))
    except (OSError, ValueError, KeyError):
        return None
    row = record["row"]
    if not same or (row["status"] == "done" and not all(os.path.exists(path) for path in job.outputs())):
        return None
    return row
