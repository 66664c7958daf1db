"""The cluster that does the work, and the stream of its answers."""

from __future__ import annotations

import time
from contextlib import contextmanager
from itertools import islice
from typing import TYPE_CHECKING, Any, Iterator

from .job import Job, write_record
from .task import row_of, run_task

if TYPE_CHECKING:
    from distributed import Client


@contextmanager
def connected(scheduler: str | None, workers: int | None) -> Iterator[Client]:
    """A client of the scheduler at that address, or of a cluster on this machine with one worker a core."""
    import dask
    from distributed import Client, LocalCluster

    if scheduler is not None:
        with Client(scheduler) as client:
            yield client
        return
    # A worker holds only the mesh that it works on, so one that dies takes no other with it; the second time its mesh is to
    # blame. One that died is started again however long that takes on a busy machine; Dask would give it up after 15 s, and
    # without any worker the batch would wait for ever.
    careful = {
        "distributed.scheduler.worker-saturation": 1.0,
        "distributed.scheduler.allowed-failures": 1,
        "distributed.deploy.lost-worker-timeout": "1 day",
    }
    with dask.config.set(careful), LocalCluster(
        n_workers=workers, threads_per_worker=1, memory_limit=0, dashboard_address=":0"
    ) as cluster, Client(cluster) as client:
        yield client


def answers(client: Client, jobs: list[Job], window: int = 8) -> Iterator[dict[str, Any]]:
    """Rows as they come. At most `window` jobs a thread are with the scheduler, so that it holds little.

    Workers come and go; once a second the number of threads is asked for again.
    """
    from distributed import as_completed

    waiting = iter(jobs)
    known: dict[str, tuple[Job, float]] = {}
    stream = as_completed()

    most, asked = 0, float("-inf")

    def submit() -> None:
        nonlocal most, asked
        if time.monotonic() > asked + 1:
            most = max(1, window * sum(client.nthreads().values()))
            asked = time.monotonic()
        for job in islice(waiting, max(0, most - len(known))):
            future = client.submit(run_task, job, pure=False)
            known[future.key] = (job, time.monotonic())
            stream.add(future)

    submit()
    for future in stream:
        job, start = known.pop(future.key)
        yield future.result() if future.status == "finished" else _lost(job, future, time.monotonic() - start)
        future.release()
        submit()


def _lost(job: Job, future: Any, seconds: float) -> dict[str, Any]:
    """The row of a job whose task ended without an answer."""
    from distributed import KilledWorker

    error = future.exception() if future.status == "error" else None
    if error is None:
        raise ConnectionError("the scheduler is gone; what is done is kept, and the same call goes on from there")
    status, message = "failed", str(error)
    if isinstance(error, KilledWorker):
        status, message = "worker died", f"every worker that it was given to died, the last one at {error.last_worker.address}"
    row = row_of(job, {"status": status, "error": type(error).__name__, "message": message}, seconds)
    write_record(job, row)
    return row
