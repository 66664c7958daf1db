#!/usr/bin/env python3
"""Are a shape's parts the same in another pose, turned, or with four times the faces?

usage: parts_stability.py PROGRAM MESH.off... [--keep DIR]

For each mesh 1 - Rand index on faces (scripts/rand_index.py) between its parts and those of the same mesh
  pose     with the first joint of each limb bent by 20 to 30 degrees, about x, y and z by turns (--rig, --pose, --bent)
  turned   turned about an axis of no symmetry
  finer    with each face cut into four, whose parts are compared on the middle ones
and how many parts there are each time. 0 is full agreement. --keep leaves the meshes and parts in DIR.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

from rand_index import disagreement, read

ANGLES = (20, 25, 30)


def read_off(path):
    words = path.read_text(encoding="ascii").split()
    vertices, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    points = [tuple(map(float, numbers[3 * v : 3 * v + 3])) for v in range(vertices)]
    rest = numbers[3 * vertices :]
    return points, [tuple(map(int, rest[4 * f + 1 : 4 * f + 4])) for f in range(faces)]


def write_off(path, points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += ["%.17g %.17g %.17g" % p for p in points] + ["3 %d %d %d" % f for f in faces]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def turned(points):
    axis, angle = (0.36, 0.48, 0.8), 1.1
    c, s = math.cos(angle), math.sin(angle)
    def turn(p):
        along = sum(a * x for a, x in zip(axis, p))
        cross = [axis[i - 2] * p[i - 1] - axis[i - 1] * p[i - 2] for i in range(3)]
        return tuple(c * p[i] + s * cross[i] + (1 - c) * along * axis[i] for i in range(3))
    return [turn(p) for p in points]


def finer(points, faces):
    points, middle = list(points), {}
    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
        return middle[key]
    cut = []
    for a, b, c in faces:
        p, q, r = between(a, b), between(b, c), between(c, a)
        cut += [(a, p, r), (p, b, q), (r, q, c), (p, q, r)]
    return points, cut


def run(program, *arguments):
    subprocess.run([program, *map(str, arguments), "-q"], check=True)


def parts(program, mesh):
    run(program, mesh, mesh.with_suffix(".skel"), "--segments", mesh.with_suffix(".seg"))
    return read(mesh.with_suffix(".seg"))


def bend(program, mesh, bent):
    rig = bent.with_suffix(".rig.txt")
    run(program, mesh, rig)
    names = [line.split()[1] for line in rig.read_text(encoding="ascii").splitlines() if line.startswith("joints limb")]
    first = [name for name in names if name.split("_")[1] == "1"]
    poses = []
    for i, name in enumerate(first):
        poses += ["--pose", f"{name}={'xyz'[i % 3]},{ANGLES[i // 3 % 3] * (-1) ** i}"]
    run(program, mesh, rig.with_suffix(".glb"), "--rig", *poses, "--bent", bent)


def measure(program, path, folder):
    points, faces = read_off(path)
    names = {kind: folder / f"{path.stem}_{kind}.off" for kind in ("rest", "pose", "turned", "finer")}
    write_off(names["rest"], points, faces)
    bend(program, names["rest"], names["pose"])
    write_off(names["turned"], turned(points), faces)
    write_off(names["finer"], *finer(points, faces))
    own = parts(program, names["rest"])
    found = {kind: parts(program, names[kind]) for kind in ("pose", "turned", "finer")}
    on_rest = dict(found, finer=found["finer"][3::4])
    return [(disagreement(own, on_rest[kind]), len(set(found[kind]))) for kind in found], len(set(own))


def main(arguments):
    keep = None
    if "--keep" in arguments:
        at = arguments.index("--keep")
        keep = pathlib.Path(arguments[at + 1])
        keep.mkdir(parents=True, exist_ok=True)
        arguments = arguments[:at] + arguments[at + 2 :]
    if len(arguments) < 2:
        raise SystemExit(__doc__)
    print(f"{'mesh':16} parts |   pose parts | turned parts |  finer parts")
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        for path in map(pathlib.Path, arguments[1:]):
            row, count = measure(arguments[0], path, keep or pathlib.Path(temporary))
            rows.append([score for score, _ in row])
            print(f"{path.stem:16} {count:5} | " + " | ".join(f"{score:6.3f} {n:5}" for score, n in row), flush=True)
    for name, show in (("mean", lambda c: sum(c) / len(c)), ("worst", max)):
        print(f"{name:16}       | " + " | ".join(f"{show(column):6.3f}      " for column in zip(*rows)))
    print(f"{'below 0.05':16}       | " + " | ".join(f"{sum(x < 0.05 for x in c):6} of {len(c):2}" for c in zip(*rows)))


if __name__ == "__main__":
    main(sys.argv[1:])
