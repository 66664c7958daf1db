"""What is done with one mesh, in a process of its own."""

from __future__ import annotations

import os
import warnings
from typing import Any

from .. import SkeletonWarning, skeletonize
from .job import Job


def skeletonize_job(job: Job) -> dict[str, Any]:
    """Makes the skeleton, writes its files, and returns the row of the table."""
    os.makedirs(os.path.dirname(job.outputs()[0]), exist_ok=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SkeletonWarning)
        skeleton = skeletonize(job.mesh, **{"threads": 1, "time_limit": job.time_limit, **job.options})
    row = facts(skeleton.report)
    if job.checks:
        checks = skeleton.check()
        row.update(coverage_mean=checks["cover_mean"], coverage_p95=checks["cover_p95"])
    for path in job.outputs():
        skeleton.to(path)
    return row


def facts(report: dict[str, Any]) -> dict[str, Any]:
    """The columns that a report answers."""
    given, graph, checks = report["input"], report["skeleton"], report["checks"]
    return {
        **{name: given[name] for name in ("vertices", "faces", "components", "genus")},
        **{name: graph[name] for name in ("nodes", "edges", "cycles", "leaves", "length")},
        "mended": report["repair"]["mended"],
        "certificate": checks["topology"],
        "inside": checks["inside"],
        "peak_memory": report["peak_memory_bytes"],
        "warnings": "; ".join(report["warnings"]),
    }
