"""Many meshes on Dask: every way to fail is a row, nothing is half-written, what is done is not done again."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

import mspskel

pytest.importorskip("distributed")
pandas = pytest.importorskip("pandas")
pytest.importorskip("pyarrow")

import dask  # noqa: E402
import mspskel.batch  # noqa: E402
from mspskel.batch import Job, command  # noqa: E402
from mspskel.batch.child import Child  # noqa: E402
from mspskel.batch.scheduler import answers  # noqa: E402
from test_formats import write_off  # noqa: E402


@pytest.fixture(autouse=True)
def hooks_for_workers(monkeypatch):
    path = os.pathsep.join([os.path.dirname(__file__), os.environ.get("PYTHONPATH", "")])
    monkeypatch.setenv("PYTHONPATH", path)


@pytest.fixture(scope="session")
def meshes(tmp_path_factory):
    """A few good meshes, and one for each way to fail."""
    folder = tmp_path_factory.mktemp("meshes")
    (folder / "below").mkdir()
    good = [folder / f"good{i}.off" for i in range(3)] + [folder / "below" / "good0.off"]
    names = ["prints.off", "hangs.off", "crashes.off", "kills.off", "devours.off"]
    for number, path in enumerate(good + [folder / name for name in names]):
        write_off(path, mspskel.sample("torus", resolution=100, seed=number + 1))
    (folder / "broken.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 x\n")
    (folder / "empty.off").write_text("")
    return folder


def files_below(folder):
    return {str(p.relative_to(folder)) for p in Path(folder).rglob("*") if p.is_file() and ".mspskel" not in p.parts}


def test_every_way_to_fail_is_a_row(meshes, tmp_path):
    # Under the address sanitizer work takes longer, and its shadow memory is address space too, more than any limit.
    limit, seconds = (0, 60) if "libasan" in os.environ.get("LD_PRELOAD", "") else (1 << 33, 3)
    with dask.config.set({"distributed.deploy.lost-worker-timeout": "1 ms"}):  # workers never come back as soon as that
        table = mspskel.batch.map(
            meshes, tmp_path, workers=2, time_limit=seconds, memory_limit=limit, work="batch_hooks:work", formats=(".skel", ".swc")
        )
    rows = {Path(row.mesh).relative_to(meshes).as_posix(): row for row in table.itertuples()}
    assert len(rows) == 11
    done = {"good0.off", "good1.off", "good2.off", "below/good0.off", "prints.off"}
    assert {name for name, row in rows.items() if row.status == "done"} == done
    assert rows["hangs.off"].status == "timed out" and f"{seconds} seconds" in rows["hangs.off"].message
    assert rows["crashes.off"].status == "crashed" and "SIGABRT" in rows["crashes.off"].message
    assert rows["kills.off"].status == "worker died"
    assert rows["devours.off"].error == "MemoryError"
    assert rows["broken.off"].error == "ReadError" and "broken.off" in rows["broken.off"].message
    assert rows["empty.off"].error == "ReadError"
    assert (table[table.status == "done"].certificate == "proved").all()
    assert (table[table.status == "done"].coverage_p95 < 0.1).all()
    outputs = {name + suffix for name in done for suffix in (".skel", ".swc")}
    assert files_below(tmp_path) == outputs | {"table.csv", "table.parquet"}
    back = pandas.read_parquet(tmp_path / "table.parquet")
    assert list(back.mesh) == list(table.mesh) == list(pandas.read_csv(tmp_path / "table.csv").mesh)
    assert (tmp_path / "good0.off.skel").read_bytes() == mspskel.skeletonize(meshes / "good0.off").to_bytes("x.skel")


def test_only_what_is_missing_is_done(meshes, tmp_path, client):
    given = tmp_path / "in"
    shutil.copytree(meshes, given, ignore=lambda folder, names: [n for n in names if n[0] in "hckd"])
    out = tmp_path / "out"

    def run(**more):
        before = {p: p.stat().st_mtime_ns for p in out.rglob("*.json")} if out.exists() else {}
        table = mspskel.batch.map(given, out, client=client, time_limit=60, checks=False, **more)
        return table, {p for p in out.rglob("*.json") if before.get(p) != p.stat().st_mtime_ns}

    table, done = run()
    assert len(done) == len(table) == 7 and (table.status == "done").sum() == 5
    again, done = run()
    assert not done and again.equals(table)
    assert len(run(retry_failed=True)[1]) == 2
    os.remove(out / "good0.off.skel")
    os.utime(given / "good1.off", ns=(1, 1))
    assert len(run()[1]) == 2
    assert len(run(smallest=0.02)[1]) == 7
    one = next(out.rglob("*.json"))
    one.write_text(one.read_text()[:-20])
    assert run(smallest=0.02)[1] == {one}


@pytest.mark.parametrize("out", ["", "out"])
def test_skeletons_of_an_earlier_batch_are_no_meshes(meshes, tmp_path, client, out):
    shutil.copy(meshes / "good0.off", tmp_path / "mesh.off")
    for _ in range(2):
        table = mspskel.batch.map(tmp_path, tmp_path / out, client=client, formats=[".obj", ".vtp"], checks=False)
        assert [Path(mesh).name for mesh in table.mesh] == ["mesh.off"]
    (tmp_path / "other.obj").touch()
    assert len(mspskel.batch.find_meshes(tmp_path, out=tmp_path / out)) == 2
    assert len(mspskel.batch.find_meshes(tmp_path, out=tmp_path / "elsewhere")) == 4


def test_all_formats_of_meshes_are_found(tmp_path):
    reader = (Path(__file__).resolve().parents[2] / "include/mspskel/io/read_mesh.h").read_text()
    suffixes = re.search(r"that of the extension \(([^,]*), any case", reader).group(1).replace("//", "").split()
    assert len(suffixes) > 8
    for suffix in suffixes:
        (tmp_path / f"mesh{suffix.upper()}").touch()
        assert suffix in command.parser().format_help()
    assert len(mspskel.batch.find_meshes(tmp_path)) == len(suffixes)


def test_the_child_says_what_the_limit_ended(meshes, tmp_path, capfd):
    child = Child()
    job = Job(str(meshes / "good0.off"), "good0.off", str(tmp_path), checks=False, time_limit=60)
    assert child.run(job)["status"] == "done"
    answer = child.run(replace(job, options={"time_limit": 1e-6}))
    child.stop()
    assert (answer["status"], answer["message"]) == ("timed out", "the time limit is over")
    assert capfd.readouterr() == ("", "")


def test_workers_that_come_later_get_work(meshes, tmp_path, client, monkeypatch):
    asked, given, got = [], 0, 0

    def no_threads_at_first():
        asked.append(time.monotonic())
        return {} if len(asked) == 1 else {"late": 2}

    def submit(*words, real=client.submit, **more):
        nonlocal given
        given += 1
        return real(*words, **more)

    monkeypatch.setattr(client, "nthreads", no_threads_at_first)
    monkeypatch.setattr(client, "submit", submit)
    jobs = [Job(str(meshes / "good0.off"), f"{i}.off", str(tmp_path), work="batch_hooks:slow") for i in range(12)]
    at_once = []
    for _ in answers(client, jobs, window=2):
        at_once.append(given - got)
        got += 1
    assert at_once[0] == 1 and max(at_once) == 4 and got == given == 12


def test_what_is_wrong_shows_before_the_work(meshes, tmp_path, client):
    for bad in ({"smallest": 7}, {"formats": [".xyz"]}, {"pattern": "*.none"}, {"smalest": 1}):
        with pytest.raises(mspskel.UsageError):
            mspskel.batch.map(meshes, tmp_path / "out", client=client, **bad)
    with pytest.raises(mspskel.UsageError, match="not a folder"):
        mspskel.batch.map(tmp_path / "none", tmp_path / "out")
    with pytest.raises(mspskel.UsageError, match="below"):
        mspskel.batch.map([meshes / "good0.off"], tmp_path / "out", root=tmp_path)
    assert not (tmp_path / "out").exists()


def test_paths_from_anywhere(meshes, tmp_path, client):
    paths = [meshes / "below" / "good0.off", str(meshes / "good1.off")]
    table = mspskel.batch.map(paths, tmp_path, client=client, options=mspskel.Options(step=0.05), checks=False)
    assert files_below(tmp_path) == {"below/good0.off.skel", "good1.off.skel", "table.csv", "table.parquet"}
    assert table.coverage_mean.isna().all()


def test_killed_midway_and_started_again(tmp_path):
    given, out = tmp_path / "in", tmp_path / "out"
    given.mkdir()
    for i in range(20):
        (given / f"{i}.off").write_text("OFF")
    words = [sys.executable, "-m", "mspskel", "batch", str(given), str(out), "-q", "--workers", "2", "--work"]
    with subprocess.Popen([*words, "batch_hooks:slow"], stderr=subprocess.DEVNULL, start_new_session=True) as process:
        end = time.monotonic() + 60
        while len(list(out.rglob("*.json"))) < 4 and time.monotonic() < end:
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGKILL)
    first = {p: p.stat().st_mtime_ns for p in out.rglob("*.json")}
    assert 4 <= len(first) < 20
    for path in first:
        json.loads(path.read_text())
    result = subprocess.run([*words, "batch_hooks:slow"], capture_output=True, text=True, timeout=100)
    assert result.returncode == 5 or result.returncode == 0, result.stderr
    records = list(out.rglob("*.json"))
    assert len(records) == 20
    assert len(pandas.read_parquet(out / "table.parquet")) == 20


def test_words_of_the_command_line():
    words = ["--smallest", "0.004", "--no-coarsen", "--cone", "--mode=thesis"]
    assert command.keywords(words) == {"smallest": "0.004", "coarsen": False, "cone": True, "mode": "thesis"}
    assert command.size("4G") == 4 * 10**9 and command.size("1.5 kB") == 1500
    with pytest.raises(mspskel.UsageError):
        command.keywords(["stray"])
    assert command.run(["nowhere", "out", "-q"]) == 1
    assert subprocess.run([sys.executable, "-m", "mspskel"], capture_output=True).returncode == 1
