"""What a run left between its stages."""

from __future__ import annotations

import numpy as np

from . import _core


class RunStages:
    """Arrays with one entry a vertex of the closed surface, in the mesh's coordinates; views where nothing is scaled.

    vertices, faces   the surface: the mesh, or what it was mended or its shells were united to
    msp               minimum slice perimeter; 0 without a slice
    slice_error       0 to 1
    slice_normal      unit, of either sign
    valid             whether the vertex has a slice
    skeletal_points   the centres of the slices
    vertex_of_point   per point of the given mesh its vertex, -1 if dropped; None if they are the mesh's own
    seconds           (stage, wall seconds) in order
    """

    def __init__(self, extraction: _core.Extraction) -> None:
        self._extraction = extraction

    vertices = property(lambda self: self._extraction.vertices)
    faces = property(lambda self: self._extraction.faces)
    msp = property(lambda self: self._extraction.msp)
    slice_error = property(lambda self: self._extraction.slice_error)
    slice_normal = property(lambda self: self._extraction.slice_normal)
    valid = property(lambda self: self._extraction.slice_valid)
    skeletal_points = property(lambda self: self._extraction.skeletal_points)
    seconds = property(lambda self: self._extraction.seconds)

    @property
    def vertex_of_point(self) -> np.ndarray | None:
        return self._extraction.vertex_of_point if self._extraction.renumbered else None

    def slice(self, vertex: int) -> np.ndarray:
        """(k, 3) the slice of a vertex, a closed polygon; empty if it has none. Cost: one trace."""
        return self._extraction.contour(vertex)
