"""The process in which meshes are worked on, so that one that hangs or crashes takes nothing else with it.

A worker's thread keeps one and gives it job after job, a line of JSON each way. It ends with that thread, and is ended and
replaced where a job takes too long.
"""

from __future__ import annotations

import importlib
import json
import os
import select
import signal
import subprocess
import sys
import time
from dataclasses import asdict
from typing import Any

from .job import Job


class Child:
    """A child process of this thread."""

    def __init__(self) -> None:
        self._process: subprocess.Popen | None = None

    def run(self, job: Job) -> dict[str, Any]:
        """The job's answer: a row, or status, error and message. Never raises for what the job does."""
        if self._process is None or self._process.poll() is not None:
            command = [sys.executable, "-c", "from mspskel.batch.child import main; main()"]
            self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        try:
            self._process.stdin.write(json.dumps(asdict(job)).encode() + b"\n")
            self._process.stdin.flush()
        except OSError:
            pass  # it has died, which the end of its answers tells
        line = self._answer(_patience(job.time_limit))
        return self._ended(job, line) if line is None or not line.endswith(b"\n") else json.loads(line)

    def _answer(self, seconds: float | None) -> bytes | None:
        """The next line, what there is of it at the end of file, or None when the time is over."""
        output = self._process.stdout.fileno()
        end = None if seconds is None else time.monotonic() + seconds
        line = b""
        while not line.endswith(b"\n"):
            left = None if end is None else max(0.0, end - time.monotonic())
            if not select.select([output], [], [], left)[0]:
                return None
            part = os.read(output, 1 << 16)
            if not part:
                break
            line += part
        return line

    def _ended(self, job: Job, line: bytes | None) -> dict[str, Any]:
        if line is None:
            self.stop()
            return {"status": "timed out", "message": f"no answer within {job.time_limit:g} seconds; the process was ended"}
        code = self._process.wait()
        self._process = None
        reason = signal.Signals(-code).name if code < 0 else f"exit status {code}"
        return {"status": "crashed", "message": f"the process died: {reason}"}

    def stop(self) -> None:
        """Ends the process."""
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
            self._process = None


def _patience(time_limit: float) -> float | None:
    """The engine keeps the limit by itself; what is still busy some time later hangs. A new process takes a while to start."""
    return time_limit * 1.1 + 5 if time_limit > 0 else None


def _die_with_parent() -> None:
    """Asks Linux for a signal when the thread that started this process ends, however it ends."""
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def _limit_memory(size: int) -> None:
    import resource

    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (size if size > 0 else most, most))


def _work(job: Job) -> dict[str, Any]:
    from ..errors import Cancelled, Error

    module, function = job.work.split(":")
    try:
        _limit_memory(job.memory_limit)
        return {"status": "done", **getattr(importlib.import_module(module), function)(job)}
    except Cancelled as error:  # by the limit: nobody else asks for it here
        return {"status": "timed out", "error": type(error).__name__, "message": str(error)}
    except Error as error:
        return {"status": "failed", "error": type(error).__name__, "message": str(error)}
    except MemoryError:
        return {"status": "failed", "error": "MemoryError", "message": f"not enough memory: {job.memory_limit} bytes"}
    except Exception as error:
        return {"status": "failed", "error": type(error).__name__, "message": str(error)}


def main() -> None:
    """Answers jobs until there are no more; whatever a job prints goes to standard error."""
    _die_with_parent()
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    for line in sys.stdin.buffer:
        given = json.loads(line)
        given["formats"] = tuple(given["formats"])
        answers.write(json.dumps(_work(Job(**given))).encode() + b"\n")
        answers.flush()

