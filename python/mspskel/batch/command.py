"""python -m mspskel batch IN OUT [options]"""

from __future__ import annotations

import argparse
import re
import sys
from typing import Any

from ..errors import Error, UsageError
from ..options import describe
from . import map as map_meshes
from .jobs import MESH_SUFFIXES

UNITS = {"": 1, "k": 10**3, "m": 10**6, "g": 10**9, "t": 10**12}


def parser() -> argparse.ArgumentParser:
    """The options of the batch itself."""
    p = argparse.ArgumentParser(
        prog="python -m mspskel batch",
        description="Skeletons of all meshes in a folder, on Dask. Exit status 0 if every mesh is done, 5 if some failed.",
        epilog="Further options are those of `mspskel` that say what is computed, such as --smallest 0.004.",
        allow_abbrev=False,
    )
    p.add_argument("IN", help=f"folder with meshes ({' '.join(MESH_SUFFIXES)})")
    p.add_argument("OUT", help="folder for skeletons, table.csv and table.parquet")
    p.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster; without it workers are started here")
    p.add_argument("--workers", type=int, metavar="N", help="started here; as many as the machine has cores by default")
    p.add_argument("--glob", metavar="PATTERN", help="which files below IN, for example '*.stl'")
    p.add_argument("--format", action="append", metavar="EXTENSION", help="of the outputs, may be repeated [.skel]")
    p.add_argument("--time-limit", type=float, default=600, metavar="N", help="seconds a mesh; 0: none [600]")
    p.add_argument("--memory-limit", type=size, default=0, metavar="SIZE", help="a mesh, for example 4G; 0: none [0]")
    p.add_argument("--retry-failed", action="store_true", help="do again what failed before")
    p.add_argument("--no-checks", action="store_true", help="do not measure coverage")
    p.add_argument("--work", default=argparse.SUPPRESS, help=argparse.SUPPRESS)
    p.add_argument("-q", "--quiet", action="store_true", help="no progress")
    return p


def size(text: str) -> int:
    """Bytes from 4G, 500M, 1000000."""
    match = re.fullmatch(r"(\d+(?:\.\d+)?)\s*([kmgt]?)i?b?", text.strip().lower())
    if match is None:
        raise argparse.ArgumentTypeError(f"{text} is no size such as 4G")
    return int(float(match[1]) * UNITS[match[2]])


def keywords(words: list[str]) -> dict[str, Any]:
    """Options of the engine from words such as --smallest 0.004 --no-coarsen."""
    switches = {row["name"] for row in describe() if not row["value"]}
    found: dict[str, Any] = {}
    rest = iter(words)
    for word in rest:
        if not word.startswith("--"):
            raise UsageError(f"too many arguments: {word}")
        name, equals, value = word[2:].partition("=")
        if name.startswith("no-") and name[3:] in switches:
            found[name[3:]] = False
        elif name in switches and not equals:
            found[name] = True
        else:
            found[name] = value if equals else next(rest, "")
    return {name.replace("-", "_"): value for name, value in found.items()}


def run(words: list[str]) -> int:
    """Does the batch and returns the exit status."""
    given, rest = parser().parse_known_args(words)
    try:
        table = map_meshes(
            given.IN,
            given.OUT,
            scheduler=given.scheduler,
            workers=given.workers,
            pattern=given.glob,
            formats=given.format or [".skel"],
            checks=not given.no_checks,
            time_limit=given.time_limit,
            memory_limit=given.memory_limit,
            retry_failed=given.retry_failed,
            progress=not given.quiet,
            **({"work": given.work} if hasattr(given, "work") else {}),
            **keywords(rest),
        )
    except Error as error:
        print(f"mspskel: error: {error}", file=sys.stderr)
        return error.exit_status
    failed = table[table["status"] != "done"]
    for mesh, message in zip(failed["mesh"], failed["message"]):
        print(f"mspskel: {mesh}: {message}", file=sys.stderr)
    print(f"{len(table) - len(failed)} done, {len(failed)} failed")
    return 5 if len(failed) else 0
