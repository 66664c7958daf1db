"""Work that hangs, crashes or takes its worker along, by the mesh's name."""

import os
import signal
import time

from mspskel.batch.work import skeletonize_job


def worker_process():
    """The parent, which is the Dask worker."""
    return os.getppid()


def work(job):
    name = os.path.basename(job.mesh)
    if name.startswith("hangs"):
        time.sleep(1000)
    if name.startswith("crashes"):
        os.kill(os.getpid(), signal.SIGABRT)  # sanitizers take SIGSEGV for a fault of their own
    if name.startswith("kills"):
        os.kill(worker_process(), signal.SIGKILL)
        time.sleep(1000)
    if name.startswith("prints"):
        print("noise on standard output", flush=True)
    if name.startswith("devours"):
        return {"nodes": len(bytearray(1 << 40))}
    return skeletonize_job(job)


def slow(job):
    time.sleep(0.2)
    return {"nodes": 1}
