"""From paths to jobs."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Iterable, Sequence

from ..errors import UsageError
from ..options import Options
from .job import Job

#: What a folder's meshes are known by: all that the engine reads.
MESH_SUFFIXES = (".off", ".obj", ".ply", ".stl", ".vtk", ".vtp", ".gltf", ".glb", ".3mf")


def find_meshes(
    folder: str | os.PathLike, pattern: str | None = None, out: str | os.PathLike | None = None
) -> list[Path]:
    """The files below the folder that match, in order; without a pattern all meshes by extension.

    Where `out` is the folder or lies in it, what an earlier batch made there of the other files is left out: some formats of
    skeletons have extensions of meshes. Raises UsageError for what is not a folder.
    """
    base = Path(folder)
    if not base.is_dir():
        raise UsageError(f"{base} is not a folder")
    found = (path for path in base.rglob(pattern or "*") if path.is_file())
    meshes = sorted(path for path in found if pattern or path.suffix.lower() in MESH_SUFFIXES)
    if out is None:
        return meshes
    made = {os.path.join(os.path.abspath(out), path.relative_to(base)) for path in meshes}
    return [path for path in meshes if os.path.splitext(os.path.abspath(path))[0] not in made]


def make_jobs(
    paths: Iterable[str | os.PathLike], out: str | os.PathLike, root: str | os.PathLike | None, **settings: Any
) -> list[Job]:
    """A job for each path; outputs are named by the path below `root`, or else below what all paths have in common.

    Raises UsageError for two paths of one name, and for options or formats that do not exist.
    """
    meshes = [os.path.abspath(path) for path in paths]
    if not meshes:
        raise UsageError("no meshes were found")
    base = os.path.abspath(root) if root is not None else os.path.commonpath([os.path.dirname(m) for m in meshes])
    check_settings(settings.get("formats", (".skel",)), settings.get("options", {}))
    names: dict[str, str] = {}
    for mesh in meshes:
        name = os.path.relpath(mesh, base)
        if name.startswith("..") or names.setdefault(name, mesh) != mesh:
            raise UsageError(f"{mesh} does not lie below {base}")
    return [Job(mesh, name, os.path.abspath(out), **settings) for name, mesh in names.items()]


def check_settings(formats: Sequence[str], options: dict[str, Any]) -> None:
    """What is wrong with the settings shows before the work, not in every row."""
    import numpy as np

    from .. import _core

    empty = _core.Graph(np.zeros((0, 3)), np.zeros((0, 2), np.int32), np.zeros((0, 4)), np.zeros(0, np.int32))
    for suffix in formats:
        if suffix not in (".glb", ".html", ".htm"):
            _core.losses_of_format(empty, "x" + suffix)
    Options(**options)
