#!/usr/bin/env python3
"""How far are segmentations from people's? 1 - Rand index on faces, as the Princeton segmentation benchmark has it.

usage: rand_index.py SEGMENTS_DIR PEOPLE_DIR [IDS...]

SEGMENTS_DIR has N.seg, PEOPLE_DIR N/*.seg for each mesh N: the number of a part a line, one line a face. The score of a mesh is
the mean over its people; that of a class of the benchmark, and the one of all, the mean over meshes. Beside it, people's own
(each against the others on the same mesh) and two trivial answers: one part, and a part for each face. 0 is full agreement.
"""
import collections
import pathlib
import statistics
import sys

CLASSES = ("human cup glasses airplane ant chair octopus table teddy hand plier fish bird - armadillo bust mechanical bearing vase"
           " four-legged").split()
COLUMNS = ("score", "people", "one part", "each face")


def pairs(counts):
    return sum(n * (n - 1) // 2 for n in counts)


def disagreement(a, b):
    """Share of the pairs of faces that one puts into one part and the other does not."""
    if len(a) != len(b):
        raise SystemExit(f"segmentations of {len(a)} and {len(b)} faces cannot be compared")
    together = pairs(collections.Counter(zip(a, b)).values())
    apart = pairs(collections.Counter(a).values()) + pairs(collections.Counter(b).values()) - 2 * together
    return apart / (len(a) * (len(a) - 1) // 2)


def read(path):
    return path.read_text(encoding="ascii").split()


def scores(own, people):
    against = lambda a: statistics.mean(disagreement(a, person) for person in people)
    among = [disagreement(a, b) for i, a in enumerate(people) for b in people[:i]]
    return against(own), statistics.mean(among) if among else float("nan"), against([0] * len(own)), against(range(len(own)))


def class_of(mesh):
    return CLASSES[(int(mesh) - 1) // 20] if mesh.isdigit() and 1 <= int(mesh) <= 400 else "other"


def main(arguments):
    if len(arguments) < 2:
        raise SystemExit(__doc__)
    folder, people_folder = map(pathlib.Path, arguments[:2])
    ids = arguments[2:] or sorted((p.stem for p in folder.glob("*.seg")), key=lambda s: (len(s), s))
    by_class = collections.defaultdict(list)
    for mesh in ids:
        people = [read(p) for p in sorted((people_folder / mesh).glob("*.seg"))]
        if people:
            by_class[class_of(mesh)].append(scores(read(folder / f"{mesh}.seg"), people))
    if not by_class:
        raise SystemExit("no mesh has both a segmentation and people's")
    print(f"{'class':12} meshes " + " ".join(f"{name:>9}" for name in COLUMNS))
    everything = [row for rows in by_class.values() for row in rows]
    for name, rows in [*by_class.items(), ("all", everything)]:
        means = [statistics.mean(column) for column in zip(*rows)]
        print(f"{name:12} {len(rows):6} " + " ".join(f"{x:9.4f}" for x in means))


if __name__ == "__main__":
    main(sys.argv[1:])
