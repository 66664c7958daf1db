"""Parts of a surface, and rigs that bend it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _core
from .errors import UsageError

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class Segmentation:
    """Parts of the closed surface ``stages.vertices, stages.faces``; a mesh that was neither mended nor united has the same faces.

    part_of_face   (f,) 0 to ``count`` - 1, from the largest area to the smallest; each part is connected
    part_of_node   per node of the run's skeleton, -1 where no vertex maps to it
    """

    def __init__(self, parts: _core.Segmentation) -> None:
        self.count: int = parts.count
        self.part_of_face: np.ndarray = parts.part_of_face
        self.part_of_node: np.ndarray = parts.part_of_node

    def __len__(self) -> int:
        return self.count

    def __repr__(self) -> str:
        return f"<Segmentation(parts={self.count}, faces={len(self.part_of_face)})>"


class Rig:
    """Joints that bend the closed surface ``stages.vertices, stages.faces``.

    names       of the joints, parents first: "root", "limb2_1", "body1_1"; twins end in _L and _R
    parents     per joint, -1 at the root
    positions   (j, 3) at rest, in the mesh's coordinates
    nodes       per joint, of the run's skeleton
    twins       per joint the one on the other side of the mirror plane, -1: none
    influences  (n, 4) joints that a vertex follows, the strongest first
    weights     (n, 4) how much; they sum to 1
    cut         (c, 2) edges of the skeleton that are left out, one for each of its loops
    """

    def __init__(self, rigged: _core.RiggedSurface) -> None:
        self._rigged = rigged
        self.names: list[str] = rigged.names
        self.parents: np.ndarray = rigged.parents
        self.positions: np.ndarray = rigged.positions
        self.nodes: np.ndarray = rigged.nodes
        self.twins: np.ndarray = rigged.twins
        self.influences: np.ndarray = rigged.joints_of_vertices
        self.weights: np.ndarray = rigged.weights
        self.cut: np.ndarray = rigged.cut

    def bend(self, pose: Mapping[str, tuple[Any, float]]) -> np.ndarray:
        """(n, 3) the surface's vertices with joints turned: ``{"limb2_1": ("x", 45)}``, degrees about x, y, z or a vector.

        Raises UsageError for a joint or an axis that is none.
        """
        return self._rigged.bend(_turns(pose))

    def to(self, path: str | os.PathLike, pose: Mapping[str, tuple[Any, float]] | None = None) -> str:
        """Writes .glb, a skinned mesh in that pose, or .rig.txt, RigNet's form. Returns the path. Raises UsageError, WriteError."""
        path = os.fspath(path)
        if path.lower().endswith(".glb"):
            _core.write_file(path, self._rigged.glb(_turns(pose or {})))
        elif path.lower().endswith(".rig.txt"):
            _core.write_file(path, self._rigged.text().encode())
        else:
            raise UsageError(f"cannot tell the format of the rig {path}: known extensions are .glb .rig.txt")
        return path

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        return f"<Rig(joints={len(self.names)}, vertices={len(self.weights)})>"


def _turns(pose: Mapping[str, tuple[Any, float]]) -> list[tuple[str, tuple[float, float, float], float]]:
    turns = []
    for name, (axis, angle) in pose.items():
        if isinstance(axis, str):
            if axis not in _AXES:
                raise UsageError(f"pose: expected an axis x, y, z or three numbers, not {axis!r}")
            axis = _AXES[axis]
        x, y, z = (float(value) for value in axis)
        turns.append((name, (x, y, z), float(angle)))
    return turns


class Shapes:
    """What a skeleton is good for: parts and rigs."""

    def rig(self, joints: int = 0) -> Rig:
        """Joints and weights of the run's surface; ``joints``: how many, 0: as many as the shape asks for.

        It is the command line's ``--rig``. Raises UsageError without a run, or for a number out of range.
        """
        return Rig(_core.rig(self._run(), joints))

    def surface_segments(self, parts: int = 0) -> Segmentation:
        """The parts of the run's surface; ``parts``: how many, 0: as many as the shape asks for.

        It is the command line's ``--segments``; ``segments`` is MeshParty's name for stretches of the skeleton. Raises
        UsageError without a run, or for a number out of range.
        """
        return Segmentation(_core.segment(self._run(), parts))
