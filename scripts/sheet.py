#!/usr/bin/env python3
"""A page of pictures: the skeletons of many meshes, and beside them those of another tool.

In OUT_DIR, for every mesh NAME.off: NAME.obj and NAME.png by this program, NAME.peer.obj and NAME.peer.png by the other
tool if there is one, and index.html with all of them, which needs no network.
"""
import argparse
import collections
import concurrent.futures
import html
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import urllib.parse

EPILOG = """\
example:
  scripts/sheet.py out/sheet meshes/*.off --peer other/tool --args "--quiet --detail 2"

exit status: 0 done, 1 a mesh failed with this program (the page says why), 2 usage
"""

# A row of the page, two of these beside one another, fills a wide screen.
PICTURE = ["--views", "3", "--width", "300", "--height", "300", "--line-width", "3", "--threads", "1"]

PAGE = """\
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>Skeletons</title>
<style>
body {{ font: 14px sans-serif; margin: 1em; }}
table {{ border-collapse: collapse; width: 100%; }}
th, td {{ border-top: 1px solid #ccc; padding: 4px; text-align: left; vertical-align: top; }}
img {{ display: block; width: 100%; }}
.failure {{ color: #b00; white-space: pre-wrap; }}
</style>
<p>{summary} Where a skeleton leaves the solid it is red.</p>
<table>
<tr><th>mesh</th>{headings}</tr>
{rows}
</table>
</html>
"""


class Failure(Exception):
    """What went wrong, for the page."""


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out_dir", metavar="OUT_DIR", type=pathlib.Path, help="made if absent")
    parser.add_argument("meshes", metavar="MESH", type=pathlib.Path, nargs="+", help="no two of the same name")
    parser.add_argument("--program", default="build/mspskel", help="makes our skeletons and all pictures [%(default)s]")
    parser.add_argument("--args", default="--quiet --threads 1",
                        help="of the program; a single word as --args=-q [%(default)s]")
    parser.add_argument("--peer", metavar="COMMAND", help="another tool, called as COMMAND MESH OUT.obj [none]")
    parser.add_argument("--jobs", metavar="N", type=int, default=len(os.sched_getaffinity(0)),
                        help="processes at once [the processors: %(default)s]")
    parser.add_argument("--time-limit", metavar="N", type=float, default=600,
                        help="of one process, seconds [%(default)s]")
    arguments = parser.parse_args()
    twice = [name for name, n in collections.Counter(mesh.stem for mesh in arguments.meshes).items() if n > 1]
    if twice:
        parser.error("more than one mesh is named " + ", ".join(twice))
    if arguments.jobs < 1:
        parser.error("--jobs must be at least 1")
    for mesh in arguments.meshes:
        if mesh.suffix == ".obj" and mesh.resolve().parent == arguments.out_dir.resolve():
            parser.error(f"{mesh} is in OUT_DIR, where skeletons are OBJ files too")
    for program in [arguments.program, *shlex.split(arguments.peer or "")[:1]]:
        if not shutil.which(program):
            parser.error(f"no such program: {program}")
    return arguments


def run(command, result, time_limit):
    """Runs a command that is to write the file named `result`. One from an earlier run does not count."""
    result.unlink(missing_ok=True)
    try:
        process = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 timeout=time_limit)
    except subprocess.TimeoutExpired:
        raise Failure(f"no result within {time_limit:g} s") from None
    said = process.stdout.decode(errors="replace").strip()[-1000:]
    if process.returncode != 0:
        raise Failure(f"{said}\nexit status {process.returncode}".strip())
    if not result.is_file():
        raise Failure(f"{said}\nexit status 0, but no {result.name}".strip())


def count(obj):
    """Nodes, leaves and independent cycles of the graph in an OBJ file, in words."""
    nodes, links = 0, set()
    for line in obj.read_text(errors="replace").splitlines():
        kind, *fields = line.split() or [""]
        if kind == "v":
            nodes += 1
        elif kind == "l":
            chain = [int(field.split("/")[0]) for field in fields]
            links.update(tuple(sorted(link)) for link in zip(chain, chain[1:]))
    degree = collections.Counter(node for link in links for node in link)
    parent = list(range(nodes + 1))

    def root(node):
        while parent[node] != node:
            parent[node] = node = parent[parent[node]]
        return node

    cycles = 0
    for a, b in links:
        a, b = root(a), root(b)
        cycles += a == b
        parent[a] = b
    leaves = sum(n == 1 for n in degree.values())
    return f"{nodes} nodes, {leaves} leaves, {cycles} cycles"


def cell(arguments, command, mesh, obj):
    """Skeleton and picture by one of the tools. `command`: its words before and after the two file names. Gives what the
    page shows, and the failure or None."""
    picture = obj.with_suffix(".png")
    picture.unlink(missing_ok=True)
    try:
        run([*command[0], mesh, obj, *command[1]], obj, arguments.time_limit)
        counts = count(obj)
        run([arguments.program, "render", mesh, obj, picture, *PICTURE], picture, arguments.time_limit)
    except (Failure, OSError, ValueError, IndexError) as failure:
        text = str(failure) or type(failure).__name__
        return f'<td class="failure">{html.escape(text)}</td>', text
    return f'<td><img src="{urllib.parse.quote(picture.name)}" alt="">{counts}</td>', None


def row(arguments, mesh):
    """The mesh's row of the page, and our failure or None. The tools run one after the other."""
    obj = arguments.out_dir / f"{mesh.stem}.obj"
    ours, failure = cell(arguments, ([arguments.program], shlex.split(arguments.args)), mesh, obj)
    cells = [f"<td>{html.escape(mesh.stem)}</td>", ours]
    if arguments.peer:
        cells.append(cell(arguments, (shlex.split(arguments.peer), []), mesh, obj.with_suffix(".peer.obj"))[0])
    return f"<tr>{''.join(cells)}</tr>", failure


def main():
    arguments = parse_arguments()
    arguments.out_dir.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(lambda mesh: row(arguments, mesh), arguments.meshes))
    failures = [(mesh, failure) for mesh, (_, failure) in zip(arguments.meshes, results) if failure]
    for mesh, failure in failures:
        print(f"{mesh}: {failure}", file=sys.stderr)
    headings = "<th>mspskel</th>" + (f"<th>{html.escape(arguments.peer)}</th>" if arguments.peer else "")
    page = arguments.out_dir / "index.html"
    page.write_text(PAGE.format(summary=f"{len(results)} meshes, {len(failures)} failed.", headings=headings,
                                rows="\n".join(text for text, _ in results)), encoding="utf-8")
    print(page)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
