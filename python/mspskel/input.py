"""From what users have, to polygons: paths, arrays, and the mesh objects of other packages."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from .errors import UsageError

EXPECTED = (
    "expected a path, (vertices, faces), or an object with vertices and faces, such as a mesh of trimesh, "
    "navis, open3d, pyvista, VTK or meshio"
)


@dataclass
class MeshInput:
    """A mesh as the engine takes it, and what it was made from."""

    soup: _core.Soup
    name: str
    source: Any


def read_mesh(mesh: Any) -> MeshInput:
    """Takes a mesh in any of the forms that EXPECTED lists.

    Raises UsageError for another one, ReadError for a file that cannot be read.
    """
    if isinstance(mesh, MeshInput):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        path = os.fspath(mesh)
        return MeshInput(_core.read_soup(path), path, mesh)
    if isinstance(mesh, _core.Soup):
        return MeshInput(mesh, "mesh", mesh)
    return MeshInput(_soup(mesh), "mesh", mesh)


def _soup(mesh: Any) -> _core.Soup:
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return of_arrays(*mesh)
    if hasattr(mesh, "GetPolys") and hasattr(mesh, "GetPoints"):
        return _of_vtk(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells"):
        return _of_meshio(mesh)
    faces = getattr(mesh, "faces", None)
    if faces is None:
        faces = getattr(mesh, "triangles", None)
    vertices = getattr(mesh, "vertices", None)
    if vertices is None or faces is None:
        raise UsageError(f"{type(mesh).__name__}: {EXPECTED}")
    return of_arrays(vertices, faces)


def of_arrays(vertices: Any, faces: Any) -> _core.Soup:
    """Polygons from points (n, 3) and corners (m, k), or triangles as one list (3m)."""
    faces = _whole_numbers(faces)
    if faces.ndim == 1 and faces.size % 3 == 0:
        faces = faces.reshape(-1, 3)
    if faces.ndim != 2:
        raise UsageError(f"faces: expected an array of shape (m, 3), not {faces.shape}")
    return _core.soup_of_rows(_points(vertices), faces)


def _points(vertices: Any) -> np.ndarray:
    points = np.ascontiguousarray(vertices, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise UsageError(f"vertices: expected an array of shape (n, 3), not {points.shape}")
    return points


def _whole_numbers(values: Any) -> np.ndarray:
    numbers = np.asarray(values)
    if numbers.size and numbers.dtype.kind not in "iu":
        raise UsageError(f"faces: expected whole numbers, not {numbers.dtype}")
    kind = np.int32 if numbers.dtype == np.int32 else np.int64
    return np.ascontiguousarray(numbers, dtype=kind)


def _of_polygons(points: Any, polygons: list) -> _core.Soup:
    """Polygons of any numbers of corners, given as arrays of shape (m, k)."""
    sizes = np.concatenate([np.full(len(part), part.shape[1], np.int64) for part in polygons] or [[]])
    corners = np.concatenate([part.ravel() for part in polygons] or [[]]).astype(np.int64)
    return _of_offsets(points, np.concatenate([[0], np.cumsum(sizes)]), corners)


def _of_offsets(points: Any, offsets: Any, corners: Any) -> _core.Soup:
    whole = [np.ascontiguousarray(values, dtype=np.int64) for values in (offsets, corners)]
    return _core.soup_of_polygons(_points(points), *whole)


def _of_vtk(mesh: Any) -> _core.Soup:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if mesh.GetStrips() is not None and mesh.GetNumberOfStrips() > 0:
        raise UsageError("the polydata has triangle strips: pass it through vtkTriangleFilter first")
    polys = mesh.GetPolys()
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    offsets, corners = (vtk_to_numpy(a) for a in (polys.GetOffsetsArray(), polys.GetConnectivityArray()))
    return _of_offsets(points, offsets, corners)


def _of_meshio(mesh: Any) -> _core.Soup:
    surfaces = [np.asarray(block.data) for block in mesh.cells if block.type in ("triangle", "quad", "polygon")]
    return _of_polygons(mesh.points, surfaces)
