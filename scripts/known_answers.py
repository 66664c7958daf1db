#!/usr/bin/env python3
"""Skeletons against known answers: samples that are made round a given skeleton, sparse, medium and four times finer, each also with noise
and turned.

Prints a line a family and one over all: the tips of at least two own radii that are found, the leaves that are none, how far ends are
from where they should be, how far arcs run from the truth, and in how many cases the loops are right; then all that is missed. --trees
does the same for trees of 20 to 1000 tips, with faces and time. Needs numpy and scipy.
"""
import argparse
import collections
import dataclasses
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree

SOURCE = pathlib.Path(__file__).resolve().parent.parent

LEAST_TIP = 2.0  # own radii beyond the joint's ball: what is shorter is found or not
REACH = 1.5  # radii: a leaf that is no farther from a tip stands for it
JOINT = 1.5  # radii: nearer to a joint the way of an arc is a matter of taste
STEP = 0.25  # radii between two points of an arc

# What a family is called here, the sample, its options. Each is a solid that people agree on.
FAMILIES = [
    *((f"hammer {s}", "hammer", ["--section", s]) for s in ("square", "round")),
    *((f"hammer {s} thin", "hammer", ["--section", s, "--ratio", "0.2"]) for s in ("square", "round")),
    *((f"tee {s}", "tee", ["--section", s]) for s in ("square", "round")),
    *((f"tee {s} equal", "tee", ["--section", s, "--ratio", "1"]) for s in ("square", "round")),
    *((f"cross {s} {n}", "cross", ["--section", s, "--count", str(n)]) for s in ("square", "round") for n in (3, 4, 5, 6)),
    *((f"cube-rods {s} {n}", "cube-rods", ["--section", s, "--count", str(n)]) for s in ("square", "round") for n in range(1, 7)),
    *((f"comb {s} {n}", "comb", ["--section", s, "--count", str(n)]) for s in ("square", "round") for n in (3, 5, 9)),
    *((f"ladder {s} {n}", "ladder", ["--section", s, "--count", str(n)]) for s in ("square", "round") for n in (3, 6)),
    *((f"lattice {s} {n}", "lattice", ["--section", s, "--count", str(n)]) for s in ("square", "round") for n in (2, 3)),
    *(
        (f"table {s} {n} {where}", "table", ["--section", s, "--count", str(n), "--ratio", ratio])
        for s in ("square", "round")
        for n in (3, 4, 5, 6, 8)
        for where, ratio in (("rim", "1"), ("inset", "0.7"))
    ),
    *((f"chair {ratio}", "chair", ["--ratio", ratio]) for ratio in ("0.6", "1", "1.6")),
    *(
        ("box " + " ".join(sides), "box", [w for k, side in zip("xyz", sides) for w in (f"--side-{k}", side)])
        for sides in (("10", "5", "2"), ("8", "2", "2"), ("9", "3", "2"), ("4", "2", "1"))
    ),
    *(
        ("ellipsoid " + " ".join(sides), "ellipsoid", [w for k, side in zip("xyz", sides) for w in (f"--side-{k}", side)])
        for sides in (("6", "4", "2"), ("8", "3", "3"), ("9", "3", "2"))
    ),
    *((f"vase {n}", "vase", ["--count", str(n)]) for n in range(4)),
    ("teapot", "teapot", []),
    *((f"airway {n}", "airway", ["--count", str(n)]) for n in (2, 3, 4)),
    *((f"tree {n}", "tree", ["--count", str(n), "--seed", str(n)]) for n in (10, 20)),
    *((name, name, []) for name in ("y-tube", "quadruped", "octoped", "torus", "capsule", "tube", "prism", "heptoroid", "trefoil")),
]
FINENESS = {"sparse": (1, ["--sparse"]), "medium": (1, []), "fine": (4, [])}
FORMS = {"": ([], False), "noise": (["--jitter", "0.2"], False), "turned": ([], True)}
TREES = (20, 80, 300, 1000)


def run(*words):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=900)


@dataclasses.dataclass
class Graph:
    points: np.ndarray
    radius: np.ndarray
    neighbours: list

    @staticmethod
    def read(path):
        lines = path.read_text().splitlines()[2:]
        rows = [line.split() for line in lines]
        return Graph(np.array([[float(x) for x in row[1:4]] for row in rows]), np.array([float(row[4]) for row in rows]),
                     [[int(x) for x in row[6:]] for row in rows])

    def nodes_of_degree(self, wanted):
        return [i for i, n in enumerate(self.neighbours) if wanted(len(n))]

    def edges(self):
        return [(i, j) for i, n in enumerate(self.neighbours) for j in n if i < j]

    def loops(self):
        """Pieces and independent loops."""
        seen, pieces = set(), 0
        for start in range(len(self.points)):
            if start in seen:
                continue
            pieces += 1
            open_nodes = [start]
            seen.add(start)
            while open_nodes:
                for j in self.neighbours[open_nodes.pop()]:
                    if j not in seen:
                        seen.add(j)
                        open_nodes.append(j)
        return pieces, len(self.edges()) - len(self.points) + pieces

    def limb(self, leaf):
        """Length from a leaf to the joint's ball, or to the other end, and the limb's own radius, which a tip has."""
        before, node, length = None, leaf, 0.0
        while True:
            ahead = [j for j in self.neighbours[node] if j != before]
            if (before is not None and len(self.neighbours[node]) != 2) or not ahead:
                break
            length += np.linalg.norm(self.points[ahead[0]] - self.points[node])
            before, node = node, ahead[0]
        if len(self.neighbours[node]) > 1:
            length -= self.radius[node]
        return length, self.radius[leaf]

    def samples(self):
        """Points along all edges, a share of the local radius apart, with that radius and the share of the length of each."""
        points, radius, weight = [], [], []
        for i, j in self.edges():
            length = np.linalg.norm(self.points[j] - self.points[i])
            count = max(1, math.ceil(length / (STEP * max(min(self.radius[i], self.radius[j]), 1e-9))))
            for t in (np.arange(count) + 0.5) / count:
                points.append((1 - t) * self.points[i] + t * self.points[j])
                radius.append((1 - t) * self.radius[i] + t * self.radius[j])
                weight.append(length / count)
        return np.array(points).reshape(-1, 3), np.array(radius), np.array(weight)


@dataclasses.dataclass
class Outcome:
    wanted: int = 0  # tips of at least LEAST_TIP radii
    found: int = 0
    leaves: int = 0
    false: list = dataclasses.field(default_factory=list)  # places
    missed: list = dataclasses.field(default_factory=list)
    ends: list = dataclasses.field(default_factory=list)  # radii
    distance: float = float("nan")  # radii
    loops: bool = False
    faces: int = 0
    seconds: float = 0.0
    failure: str = ""


def compare(truth, made):
    """Tips to leaves, each at most once, nearest first over all; then ends and arcs."""
    outcome = Outcome(loops=truth.loops() == made.loops())
    tips = truth.nodes_of_degree(lambda n: n == 1)
    leaves = made.nodes_of_degree(lambda n: n == 1)
    outcome.leaves = len(leaves)
    limbs = [truth.limb(tip) for tip in tips]
    wanted = [length >= LEAST_TIP * own for length, own in limbs]
    outcome.wanted = int(sum(wanted))
    taken = set()
    if tips and leaves:
        away = np.linalg.norm(truth.points[tips][:, None] - made.points[leaves][None], axis=2)
        away /= np.array([own for _, own in limbs])[:, None]
        rows, columns = linear_sum_assignment(np.minimum(away, 10 * REACH))
        for row, column in zip(rows, columns):
            if away[row, column] <= REACH:
                taken.add(column)
                if wanted[row]:
                    outcome.ends.append(float(away[row, column]))
                outcome.found += int(wanted[row])
                wanted[row] = False
    outcome.missed = [truth.points[tip].round(2).tolist() for tip, is_missed in zip(tips, wanted) if is_missed]
    outcome.false = [made.points[leaf].round(2).tolist() for k, leaf in enumerate(leaves) if k not in taken]
    outcome.distance = arc_distance(truth, made, tips)
    return outcome


def arc_distance(truth, made, tips):
    """Mean over the length of the arcs outside of the joints, radii of the nearest part."""
    points, radius, _ = truth.samples()
    where, _, weight = made.samples()
    if not len(where) or not len(points):
        return float("nan")
    joints = truth.nodes_of_degree(lambda n: n > 2)
    kept = np.ones(len(where), bool)
    for node in joints:
        kept &= np.linalg.norm(where - truth.points[node], axis=1) > JOINT * truth.radius[node]
    if not kept.any():
        return 0.0
    away, nearest = cKDTree(points).query(where[kept])
    # A point between two samples is not farther than it is from the line through them.
    away = np.sqrt(np.maximum(0, away**2 - (0.5 * STEP * radius[nearest]) ** 2 * (away > STEP * radius[nearest])))
    return float(np.average(away / radius[nearest], weights=weight[kept]))


def turn_files(mesh, truth):
    """Turns both about a skew axis and moves them."""
    axis, angle = np.array([0.3, -0.7, 0.64]), 1.1
    axis /= np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn = np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k
    lines = mesh.read_text().splitlines()
    count = int(lines[1].split()[0])
    points = np.array([line.split()[:3] for line in lines[2 : 2 + count]], float) @ turn.T + [3, -5, 7]
    mesh.write_text("\n".join(lines[:2] + ["%r %r %r" % tuple(map(float, p)) for p in points] + lines[2 + count :]) + "\n")
    truth.points = truth.points @ turn.T + [3, -5, 7]


def one(program, folder, sample, options, fineness, form, extra=()):
    mesh, skeleton, true = folder / "mesh.off", folder / "made.skel", folder / "truth.skel"
    factor, words = FINENESS[fineness]
    noise, turned = FORMS[form]
    if factor > 1:
        made = run(program, "sample", sample, folder / "medium.off", *options)
        resolution = factor * int((folder / "medium.off").read_text().split("\n", 2)[1].split()[0]) if made.returncode == 0 else 0
        words = [*words, "--resolution", resolution]
    made = run(program, "sample", sample, mesh, *options, *words, *noise, "--truth", true)
    if made.returncode:
        return Outcome(failure=made.stderr.strip())
    truth = Graph.read(true)
    if turned:
        turn_files(mesh, truth)
    started = os.times()
    run_of = run(program, mesh, skeleton, "-q", "--keep-failed", *extra)
    ended = os.times()
    if not skeleton.exists():
        return Outcome(failure=run_of.stderr.strip())
    outcome = compare(truth, Graph.read(skeleton))
    outcome.failure = run_of.stderr.strip() if run_of.returncode else ""
    outcome.faces = int(mesh.read_text().split("\n", 2)[1].split()[1])
    outcome.seconds = ended.children_user - started.children_user
    skeleton.unlink()
    return outcome


def summary(outcomes):
    ends = [e for o in outcomes for e in o.ends]
    distances = [o.distance for o in outcomes if not math.isnan(o.distance)]
    share = lambda good: sum(map(good, outcomes)) / len(outcomes)
    return (
        f"cases {len(outcomes):4d}  all tips {share(lambda o: not o.failure and o.found == o.wanted):.3f}  "
        f"no false leaf {share(lambda o: not o.failure and not o.false):.3f}  "
        f"recall {sum(o.found for o in outcomes) / max(1, sum(o.wanted for o in outcomes)):.3f}  "
        f"false {sum(len(o.false) for o in outcomes):3d}  "
        f"ends {np.mean(ends) if ends else 0:.2f}, beyond 0.5: {sum(e > 0.5 for e in ends)}  "
        f"distance {np.mean(distances) if distances else 0:.3f}, worst {max(distances, default=0):.2f}  "
        f"loops {share(lambda o: o.loops):.3f}"
    )


def say_misses(name, outcome):
    if outcome.failure:
        print(f"  {name}: {outcome.failure}")
    if outcome.missed or outcome.false or not outcome.loops:
        print(f"  {name}: missed {outcome.missed} false {outcome.false}{'' if outcome.loops else ' loops wrong'}")


def all_families(program, given):
    everything, groups = {}, collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        for name, sample, options in FAMILIES:
            if given.only and sample not in given.only and name not in given.only:
                continue
            for fineness in given.fineness:
                for form in FORMS:
                    case = " ".join(word for word in (name, fineness, form) if word)
                    outcome = one(program, pathlib.Path(folder), sample, options, fineness, form, given.option)
                    everything[case] = outcome
                    groups[sample].append(outcome)
                    groups["= " + fineness].append(outcome)
                    groups["= " + (form or "as it is")].append(outcome)
                    say_misses(case, outcome)
                    sys.stdout.flush()
    for sample, outcomes in groups.items():
        print(f"{sample:12s} {summary(outcomes)}")
    print(f"{'over all':12s} {summary(list(everything.values()))}")
    return everything


def all_trees(program, given):
    everything = {}
    with tempfile.TemporaryDirectory() as folder:
        for tips in TREES:
            outcome = one(program, pathlib.Path(folder), "tree", ["--count", tips], "medium", "", given.option)
            everything[f"tree {tips}"] = outcome
            if outcome.failure:
                print(f"  tree {tips}: {outcome.failure}")
            print(
                f"tree {tips:5d}  recall {outcome.found / max(1, outcome.wanted):.3f}  "
                f"precision {1 - len(outcome.false) / max(1, outcome.leaves):.3f}  ends {np.mean(outcome.ends or [0]):.2f}  "
                f"distance {outcome.distance:.3f}  faces {outcome.faces}  {outcome.seconds:.1f} s  "
                f"{1e6 * outcome.seconds / max(1, outcome.faces):.0f} us a face"
            )
            sys.stdout.flush()
    return everything


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(SOURCE / "build" / "mspskel"), help="[build/mspskel]")
    parser.add_argument("--only", metavar="NAME", nargs="+", help="these samples or families alone")
    parser.add_argument("--fineness", nargs="+", choices=FINENESS, default=list(FINENESS), help="[all]")
    parser.add_argument("--trees", action="store_true", help="the trees instead of the families")
    parser.add_argument("--option", action="append", default=[], help="for the extraction, such as --option=--detail=5")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="all outcomes")
    given = parser.parse_args()
    started = time.monotonic()
    outcomes = (all_trees if given.trees else all_families)(os.path.abspath(given.program), given)
    print(f"{time.monotonic() - started:.0f} s")
    if given.json:
        given.json.write_text(json.dumps({case: dataclasses.asdict(o) for case, o in outcomes.items()}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
