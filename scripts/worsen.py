#!/usr/bin/env python3
"""Clean meshes made worse, and what becomes of their skeletons: torn, turned, doubled, split, pinched, far away and very small.

Every mesh is extracted as it is and after each kind of damage. A line a case says what is wrong: the number of pieces or loops, or where
the damage leaves the shape as it was the number of leaves; a line a kind and one over all sum up. Exit status 1 if pieces or loops are
wrong anywhere, or leaves in more than one of twenty. Needs the standard library only.
"""
import argparse
import collections
import dataclasses
import json
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent

# Samples of all kinds of topology, and their options.
SAMPLES = [
    ("quadruped", []),
    ("torus", []),
    ("tree", ["--count", "20"]),
    ("heptoroid", []),
    ("cross", ["--count", "6"]),
    ("hammer", []),
    ("teapot", []),
    ("comb", ["--count", "5"]),
    ("octoped", []),
    ("lattice", ["--count", "2"]),
]
SHORT = ["quadruped", "torus"]


@dataclasses.dataclass
class Mesh:
    points: list
    faces: list

    @staticmethod
    def read(path):
        words = path.read_text().split()
        counts = [int(w) for w in words[1:3]]
        numbers = words[4:]
        points = [tuple(float(x) for x in numbers[3 * i:3 * i + 3]) for i in range(counts[0])]
        at, faces = 3 * counts[0], []
        for _ in range(counts[1]):
            if numbers[at] != "3":
                raise SystemExit(f"worsen.py: {path} has a face that is no triangle")
            faces.append(tuple(int(w) for w in numbers[at + 1:at + 4]))
            at += 4
        return Mesh(points, faces)

    def write(self, path):
        lines = ["OFF", f"{len(self.points)} {len(self.faces)} 0"]
        lines += [" ".join(repr(x) for x in p) for p in self.points]
        lines += ["3 %d %d %d" % f for f in self.faces]
        path.write_text("\n".join(lines) + "\n")

    def box(self):
        return [(min(p[k] for p in self.points), max(p[k] for p in self.points)) for k in range(3)]

    def extent(self):
        return sum((high - low) ** 2 for low, high in self.box()) ** 0.5

    def moved(self, by, scale=1.0):
        return Mesh([tuple(scale * x + b for x, b in zip(p, by)) for p in self.points], list(self.faces))

    def with_other(self, other):
        first = len(self.points)
        return Mesh(self.points + other.points, self.faces + [tuple(first + v for v in f) for f in other.faces])

    def face_neighbours(self):
        of_edge = collections.defaultdict(list)
        for i, f in enumerate(self.faces):
            for k in range(3):
                of_edge[frozenset((f[k], f[k - 1]))].append(i)
        return [[j for k in range(3) for j in of_edge[frozenset((f[k], f[k - 1]))] if j != i] for i, f in enumerate(self.faces)]

    def vertex_neighbours(self):
        around = [set() for _ in self.points]
        for f in self.faces:
            for k in range(3):
                around[f[k]].update(f)
        return around


def minus(p, q):
    return tuple(x - y for x, y in zip(p, q))


def plus(p, q, scale=1.0):
    return tuple(x + scale * y for x, y in zip(p, q))


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


def length(p):
    return sum(x * x for x in p) ** 0.5


def normal(mesh, face):
    a, b, c = (mesh.points[v] for v in face)
    n = cross(minus(b, a), minus(c, a))
    return tuple(x / length(n) for x in n) if length(n) > 0 else (0.0, 0.0, 0.0)


# Each kind of damage: (mesh, its skeleton, a random number generator) -> the worse mesh.


def patches_removed(mesh, _, rng):
    """A tenth of the faces, in patches of a thousandth: few of them reach round a limb."""
    neighbours, gone = mesh.face_neighbours(), set()
    while len(gone) < len(mesh.faces) // 10:
        patch, size = [rng.randrange(len(mesh.faces))], max(5, len(mesh.faces) // 1000)
        seen = set(patch)
        for i in patch:
            for j in neighbours[i]:
                if j not in seen and len(patch) < size:
                    seen.add(j)
                    patch.append(j)
        gone.update(patch)
    return Mesh(mesh.points, [f for i, f in enumerate(mesh.faces) if i not in gone])


def all_reversed(mesh, *_):
    return Mesh(mesh.points, [f[::-1] for f in mesh.faces])


def third_reversed(mesh, _, rng):
    return Mesh(mesh.points, [f[::-1] if rng.random() < 1 / 3 else f for f in mesh.faces])


def split(mesh, *_):
    """Every face has points of its own."""
    points = [mesh.points[v] for f in mesh.faces for v in f]
    return Mesh(points, [(i, i + 1, i + 2) for i in range(0, len(points), 3)])


def copy_apart(mesh, *_):
    (low, high), _, _ = mesh.box()
    return mesh.with_other(mesh.moved((1.5 * (high - low), 0, 0)))


def copy_touching(mesh, *_):
    """The rightmost point of the one is the leftmost of the other."""
    right, left = max(mesh.points), min(mesh.points)
    other = mesh.moved(minus(right, left))
    other.points = [right if p == left else q for p, q in zip(mesh.points, other.points)]
    return mesh.with_other(other)


def copy_overlapping(mesh, skeleton, _):
    """Moved by a third of what is thin, farther than mere contact: one solid of nearly the same shape."""
    radii = sorted(skeleton.radii)
    return mesh.with_other(mesh.moved((max(radii[len(radii) // 10] / 3, 0.002 * mesh.extent()), 0, 0)))


def scaled_up(mesh, *_):
    return mesh.moved((0, 0, 0), 1e6)


def scaled_down(mesh, *_):
    return mesh.moved((0, 0, 0), 1e-6)


def far_away(mesh, *_):
    return mesh.moved((1e6 * mesh.extent(),) * 3)


def faces_doubled(mesh, _, rng):
    """A third of the faces twice, one of three of them turned."""
    more = [f if rng.random() < 2 / 3 else f[::-1] for f in mesh.faces if rng.random() < 1 / 3]
    faces = mesh.faces + more
    rng.shuffle(faces)
    return Mesh(mesh.points, faces)


def slivers(mesh, _, rng):
    """A tenth of the faces split at a point that lies a millionth beside an edge."""
    points, faces = list(mesh.points), []
    for f in mesh.faces:
        if rng.random() > 0.1:
            faces.append(f)
            continue
        a, b, c = (mesh.points[v] for v in f)
        points.append(plus(plus(a, minus(b, a), 0.5), minus(c, a), 1e-6))
        m = len(points) - 1
        faces += [(f[0], f[1], m), (f[1], f[2], m), (f[2], f[0], m)]
    return Mesh(points, faces)


def pinched_edges(mesh, _, rng):
    """Ten edges of four faces: at each a tetrahedron hangs on it, outside as a bump or inside as a hollow."""
    points, faces, used = list(mesh.points), list(mesh.faces), set()
    neighbours = mesh.face_neighbours()
    order = list(range(len(mesh.faces)))
    rng.shuffle(order)
    for i in order:
        if len(used) >= 10 * 4:
            break
        f, g = mesh.faces[i], mesh.faces[neighbours[i][0]]
        edge = [v for v in f if v in g]
        if len(edge) != 2 or used & (set(f) | set(g)):
            continue
        used |= set(f) | set(g)
        if f[(f.index(edge[0]) + 1) % 3] != edge[1]:
            edge.reverse()
        a, b = (mesh.points[v] for v in edge)
        up = plus(normal(mesh, f), normal(mesh, g))
        if length(up) < 1.5:
            continue
        up = tuple(x / length(up) for x in up)
        way, sign = minus(b, a), rng.choice((1, -1))
        across = cross(up, way)
        middle = plus(plus(a, way, 0.5), up, sign * 0.15 * length(way))
        p, q = len(points), len(points) + 1
        points += [plus(middle, across, 0.05), plus(middle, across, -0.05)]
        # Faces of a bump look outward, those of a hollow into it.
        for corners in ((edge[0], edge[1], p), (edge[1], edge[0], q), (edge[0], p, q), (edge[1], q, p)):
            faces.append(corners[::-1] if sign > 0 else corners)
    return Mesh(points, faces)


def pinched_vertices(mesh, _, rng):
    """Five pairs of points that are three edges apart are one."""
    around = mesh.vertex_neighbours()
    points, stands_for, used = list(mesh.points), list(range(len(mesh.points))), set()
    order = list(range(len(mesh.points)))
    rng.shuffle(order)
    pairs = 0
    for v in order:
        if pairs == 5:
            break
        two = set().union(*(around[u] for u in around[v]))
        three = set().union(*(around[u] for u in two))
        farther = sorted(three - two, key=lambda u: length(minus(points[u], points[v])))
        if not farther or used & three:
            continue
        w = farther[0]
        used |= three | set().union(*(around[u] for u in around[w]))
        points[v] = points[w] = plus(points[v], minus(points[w], points[v]), 0.5)
        stands_for[w] = v
        pairs += 1
    return Mesh(points, [tuple(stands_for[v] for v in f) for f in mesh.faces])


# Copies there are in the end, and whether the shape, and with it the leaves, is as it was.
KINDS = {
    "patches removed": (patches_removed, 1, False),
    "all reversed": (all_reversed, 1, True),
    "third reversed": (third_reversed, 1, True),
    "split": (split, 1, True),
    "copy apart": (copy_apart, 2, True),
    "copy touching": (copy_touching, 2, True),
    "copy overlapping": (copy_overlapping, 1, True),
    "scaled by 1e6": (scaled_up, 1, True),
    "scaled by 1e-6": (scaled_down, 1, True),
    "moved by 1e6": (far_away, 1, True),
    "faces doubled": (faces_doubled, 1, True),
    "slivers": (slivers, 1, True),
    "pinched edges": (pinched_edges, 1, True),
    "pinched vertices": (pinched_vertices, 1, True),
}


@dataclasses.dataclass
class Skeleton:
    pieces: int
    loops: int
    leaves: int
    radii: list
    seconds: float
    message: str


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def extract(program, mesh, folder):
    """The skeleton, or the message of a refusal."""
    skeleton, report = folder / "out.skel", folder / "out.json"
    for path in (skeleton, report):
        path.unlink(missing_ok=True)
    before = cpu_seconds()
    result = subprocess.run([program, mesh, skeleton, "--report", report], capture_output=True, text=True, timeout=600)
    seconds = cpu_seconds() - before
    if result.returncode != 0:
        return f"exit {result.returncode}: {result.stderr.strip()}"
    counts = json.loads(report.read_text())["skeleton"]
    radii = [float(line.split()[4]) for line in skeleton.read_text().splitlines()[2:]]
    return Skeleton(counts["components"], counts["cycles"], counts["leaves"], radii, seconds, result.stderr.strip())


@dataclasses.dataclass
class Tally:
    cases: int = 0
    topology: int = 0
    harmless: int = 0
    leaves: int = 0

    def add(self, other):
        for field in dataclasses.fields(self):
            setattr(self, field.name, getattr(self, field.name) + getattr(other, field.name))

    def __str__(self):
        return f"pieces and loops {self.topology} of {self.cases}, leaves {self.leaves} of {self.harmless}"


def judge(what, copies, same_shape, clean, found, verbose):
    """The tally of one case, and a line where it is wrong."""
    tally = Tally(cases=1, harmless=int(same_shape))
    if isinstance(found, str):
        print(f"  {what}: {found}", flush=True)
        return tally
    wanted = [copies * clean.pieces, copies * clean.loops, copies * clean.leaves]
    got = [found.pieces, found.loops, found.leaves]
    tally.topology = int(got[:2] == wanted[:2])
    tally.leaves = int(same_shape and got[2] == wanted[2])
    if verbose or not tally.topology or got[2] != wanted[2]:
        told = ", ".join(f"{g} {name}" + ("" if g == w else f" instead of {w}")
                         for g, w, name in zip(got, wanted, ("pieces", "loops", "leaves")))
        print(f"  {what}: {told}; {found.seconds:.2f} s", flush=True)
        if verbose and found.message:
            print(f"    {found.message}", flush=True)
    return tally


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("mesh", nargs="*", type=pathlib.Path, help="closed triangle meshes (.off); none: ten samples")
    options.add_argument("--program", default=os.environ.get("MSPSKEL_PROGRAM", SOURCE / "build" / "mspskel"), help="build/mspskel by default")
    options.add_argument("--resolution", type=int, default=0, help="vertices of the samples; 0: their own")
    options.add_argument("--kind", action="append", choices=list(KINDS), help="this damage only; may be given again")
    options.add_argument("--short", action="store_true", help="two samples only, for a test of seconds")
    options.add_argument("--seed", type=int, default=1, help="of the places of the damage")
    options.add_argument("--keep", type=pathlib.Path, help="a folder for the worse meshes")
    options.add_argument("--verbose", action="store_true", help="say what is right, too, and what the program said")
    given = options.parse_args()
    program = pathlib.Path(given.program).resolve()
    sums = {kind: Tally() for kind in given.kind or KINDS}
    with tempfile.TemporaryDirectory(prefix="mspskel-worsen-") as folder:
        folder = pathlib.Path(folder)
        meshes = list(given.mesh)
        for name, words in [] if given.mesh else [s for s in SAMPLES if not given.short or s[0] in SHORT]:
            meshes.append(folder / f"{name}.off")
            subprocess.run([program, "sample", name, meshes[-1], "--resolution", str(given.resolution), *words], check=True)
        for path in meshes:
            mesh, clean = Mesh.read(path), extract(program, path, folder)
            if isinstance(clean, str):
                raise SystemExit(f"worsen.py: {path.name} is not clean: {clean}")
            print(f"{path.stem}: {len(mesh.faces)} faces, {clean.pieces} pieces, {clean.loops} loops, {clean.leaves} leaves, "
                  f"{clean.seconds:.2f} s", flush=True)
            for kind, tally in sums.items():
                worsen, copies, same_shape = KINDS[kind]
                worse = (given.keep or folder) / f"{path.stem}_{kind.replace(' ', '_')}.off"
                worse.parent.mkdir(parents=True, exist_ok=True)
                worsen(mesh, clean, random.Random(given.seed)).write(worse)
                tally.add(judge(kind, copies, same_shape, clean, extract(program, worse, folder), given.verbose))
    total = Tally()
    for kind, tally in sums.items():
        print(f"{kind + ':':20} {tally}")
        total.add(tally)
    print(f"{'all:':20} {total}")
    return int(total.topology < total.cases or total.leaves < 0.95 * total.harmless)


if __name__ == "__main__":
    sys.exit(main())
