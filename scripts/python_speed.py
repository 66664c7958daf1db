#!/usr/bin/env python3
"""Measures what the Python package gains from two cores. Wants a machine with two idle cores and `mspskel[batch]`.

usage: python_speed.py [--threads-only] [--meshes N] [--resolution N] [--repeat N]

Prints two figures: the time of two threads on two meshes as a share of that of one after the other (0.65 or less is wanted), and how
many times as many meshes a second a batch does with two workers as with one (1.8 or more is wanted). Figures are medians of
--repeat runs whose order alternates. The start of the workers is measured on an empty folder and taken off.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import mspskel


def seconds_of(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def threads(repeat, resolution):
    meshes = [mspskel.sample("quadruped", resolution=resolution, seed=seed) for seed in (1, 2)]
    run = lambda mesh: mspskel.skeletonize(mesh, threads=1)

    def together():
        both = [threading.Thread(target=run, args=(mesh,)) for mesh in meshes]
        for thread in both:
            thread.start()
        for thread in both:
            thread.join()

    def in_turn():
        for mesh in meshes:
            run(mesh)

    in_turn()
    shares = [seconds_of(together) / seconds_of(in_turn) for _ in range(repeat)]
    return statistics.median(shares), shares


def batch(folder, workers):
    with tempfile.TemporaryDirectory() as out:
        command = [sys.executable, "-m", "mspskel", "batch", str(folder), out, "-q", "--workers", str(workers)]
        took = seconds_of(lambda: subprocess.run(command, check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL))
        done = len(list(pathlib.Path(out).rglob("*.skel")))
    return took, done


def write_off(path, vertices, faces):
    lines = [f"OFF\n{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in vertices]
    lines += ["3 " + " ".join(map(str, f)) for f in faces]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def throughput(repeat, resolution, count):
    gains = []
    with tempfile.TemporaryDirectory() as folder:
        many, one = pathlib.Path(folder, "many"), pathlib.Path(folder, "one")
        many.mkdir()
        one.mkdir()
        for i in range(count):
            write_off(many / f"{i}.off", *mspskel.sample("quadruped", resolution=resolution, seed=i + 1))
        write_off(one / "0.off", *mspskel.sample("torus", resolution=100))
        for _ in range(repeat):
            took = {}
            for workers in (1, 2):
                begin = batch(one, workers)[0]
                took[workers], done = batch(many, workers)
                if done != count:
                    raise SystemExit(f"{done} of {count} meshes were done with {workers} workers")
                took[workers] -= begin
            gains.append(took[1] / took[2])
    return statistics.median(gains), gains


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--threads-only", action="store_true")
    parser.add_argument("--meshes", type=int, default=200)
    parser.add_argument("--resolution", type=int, default=15000)
    parser.add_argument("--repeat", type=int, default=5)
    given = parser.parse_args()
    show = lambda values: ", ".join(f"{value:.2f}" for value in values)
    share, all_shares = threads(given.repeat, given.resolution)
    print(f"two threads on two meshes: {share:.3f} of one after the other ({show(all_shares)})")
    if not given.threads_only:
        gain, all_gains = throughput(min(3, given.repeat), given.resolution, given.meshes)
        print(f"two workers: {gain:.2f} times one worker's meshes a second ({show(all_gains)})")


if __name__ == "__main__":
    main()
