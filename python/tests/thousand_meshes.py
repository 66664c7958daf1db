"""The batch at size: 1,000 meshes, of which one is broken, one hangs and one kills its worker.

usage: python python/tests/thousand_meshes.py [COUNT]

Kills the run midway and starts it again, checks every file and row, then compares one worker with two on part of the meshes.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pandas

import mspskel
from test_formats import write_off

HERE = os.path.dirname(os.path.abspath(__file__))
SAMPLES = ("torus", "capsule", "prism")


def make_meshes(folder, count):
    """All but the last three are good."""
    folder.mkdir()
    for i in range(count - 3):
        name = SAMPLES[i % len(SAMPLES)]
        write_off(folder / f"{name}{i}.off", mspskel.sample(name, resolution=200, seed=i + 1))
    (folder / "broken.off").write_text("OFF\n3 1 0\n0 0\n")
    for name in ("hangs.off", "kills.off"):
        write_off(folder / name, mspskel.sample("torus", resolution=300))


def batch(folder, out, workers, *more):
    command = [sys.executable, "-m", "mspskel", "batch", str(folder), str(out), "-q", "--workers", str(workers), *more]
    return subprocess.Popen(command, start_new_session=True, stderr=subprocess.DEVNULL)


def records(out):
    return {p: p.stat().st_mtime_ns for p in Path(out).rglob("*.json")}


def interrupted_and_completed(folder, out, count):
    hooks = ("--work", "batch_hooks:work", "--time-limit", "20")
    start = time.monotonic()
    process = batch(folder, out, 2, *hooks)
    while len(records(out)) < count // 3:
        time.sleep(0.2)
    os.killpg(process.pid, signal.SIGKILL)
    first = records(out)
    print(f"killed after {len(first)} of {count}")
    batch(folder, out, 2, *hooks).wait()
    print(f"{time.monotonic() - start:.0f} s in all")
    again = [path for path, when in first.items() if records(out)[path] != when]
    print(f"{len(again)} done twice, {len(records(out))} records")
    return again


def check(out, count):
    table = pandas.read_parquet(Path(out) / "table.parquet")
    failed = table[table.status != "done"]
    print(failed[["mesh", "status", "message"]].to_string())
    assert len(table) == count and len(failed) == 3
    files = {p for p in Path(out).rglob("*") if p.is_file() and ".mspskel" not in p.parts}
    assert len(files) == count - 3 + 2, "a skeleton for each that is done, and two tables"
    for path in files:
        if path.suffix == ".skel":
            assert len(mspskel.read_skeleton(path)) > 0
    assert (table[table.status == "done"].certificate == "proved").all()
    print(f"{len(table) - len(failed)} whole results; mean {table.seconds.mean():.3f} s a mesh")


def throughput(folder, base, count):
    part = base / "part"
    part.mkdir()
    for path in sorted(folder.glob("*[0-9].off"))[:count]:
        os.link(path, part / path.name)
    for turn in range(2):
        for workers in (1, 2):
            start = time.monotonic()
            batch(part, base / f"part{turn}{workers}", workers).wait()
            print(f"{count} meshes on {workers} workers: {time.monotonic() - start:.1f} s")


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    os.environ["PYTHONPATH"] = os.pathsep.join([HERE, os.environ.get("PYTHONPATH", "")])
    with tempfile.TemporaryDirectory() as name:
        base = Path(name)
        make_meshes(base / "in", count)
        again = interrupted_and_completed(base / "in", base / "out", count)
        check(base / "out", count)
        assert not again
        throughput(base / "in", base, min(200, count - 3))


if __name__ == "__main__":
    main()
