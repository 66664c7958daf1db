"""The result: a graph of nodes and straight edges, under the names that users' code already has."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _core
from .input import MeshInput
from .measures import Measures
from .meshparty_names import MeshPartyNames
from .osteoid_names import OsteoidNames
from .output import Output
from .shapes import Shapes
from .skeletor_names import SkeletorNames
from .tree import Rows, rows_of_table


class Skeleton(SkeletorNames, OsteoidNames, MeshPartyNames, Measures, Output, Shapes):
    """Nodes, straight edges, a radius a node, and the map from the mesh's vertices.

    vertices   (n, 3) positions in the mesh's coordinates
    edges      (m, 2) nodes; where the mesh has handles, they have loops
    radii      (n,) distance to the surface; ``radius`` is the same
    mesh_map   per vertex of the mesh its node, -1 for a vertex without faces; None if there is no mesh
    warnings   what the run warned of
    failure    with ``keep_failed=True``, why the skeleton is not the mesh's; else empty

    Names are skeletor's, osteoid's (kimimaro, cloud-volume) and MeshParty's. Where those have trees, loops are cut as in SWC
    files: where they are thinnest, and trees run breadth first from the thickest node of each piece. ``swc``, once asked for, is
    the skeleton: what is changed in it shows everywhere.
    """

    def __init__(
        self,
        vertices: Any,
        edges: Any,
        radii: Any = None,
        *,
        mesh: Any = None,
        mesh_map: Any = None,
        method: str = "mspskel",
    ) -> None:
        count = len(vertices)
        values = np.zeros((count, 4))
        if radii is not None:
            values[:, 0] = radii
        owned = np.zeros(0, np.int32) if mesh_map is None else np.ascontiguousarray(mesh_map, np.int32)
        pairs = np.ascontiguousarray(np.asarray(edges).reshape(-1, 2), np.int32)
        self._adopt(_core.Graph(np.ascontiguousarray(vertices, np.float64).reshape(-1, 3), pairs, values, owned))
        self.mesh_map = None if mesh_map is None else np.asarray(mesh_map)
        self.method = method
        self._source = mesh

    def _adopt(self, graph: _core.Graph) -> None:
        self._vertices = np.array(graph.positions)
        self._radii = np.array(graph.radius)
        self._node_values = np.column_stack([graph.area, graph.perimeter, graph.slice_error])
        parents, cut = graph.forest()
        self._parents = np.array(parents, np.int64)
        self._cut = np.array(cut, np.int64).reshape(-1, 2)
        self._table: Any = None
        self._extraction: _core.Extraction | None = None
        self.warnings: tuple[str, ...] = ()
        self.failure = ""
        self.id: Any = None

    @classmethod
    def of_graph(cls, graph: _core.Graph, *, source: Any = None, method: str = "mspskel") -> Skeleton:
        """The skeleton of an engine's graph."""
        self = cls.__new__(cls)
        self._adopt(graph)
        self.mesh_map = np.array(graph.node_of_vertex) if len(graph.node_of_vertex) else None
        self.method = method
        self._source = source
        return self

    @classmethod
    def of_extraction(cls, extraction: _core.Extraction, given: MeshInput) -> Skeleton:
        """The skeleton of a run."""
        self = cls.of_graph(extraction.skeleton, source=given)
        self._extraction = extraction
        self.warnings = tuple(extraction.warnings)
        self.failure = extraction.failure
        return self

    def _rows(self) -> Rows:
        """Nodes with their parents, by row, whatever has been done to the table."""
        if self._table is not None:
            return rows_of_table(self._table)
        return Rows(np.arange(len(self._vertices)), self._vertices, self._radii, self._parents)

    def _row_edges(self) -> np.ndarray:
        """Edges as pairs of rows, those of the trees first."""
        rows = self._rows()
        children = np.flatnonzero(rows.parents >= 0)
        tree = np.column_stack([children, rows.parents[children]])
        return np.concatenate([tree, rows.find_pairs(self._cut)])

    def _graph(self) -> _core.Graph:
        """What the engine's writers and checks take."""
        rows = self._rows()
        values = np.zeros((len(rows.ids), 4))
        values[:, 0] = rows.radii
        if len(values) == len(self._node_values):
            values[:, 1:] = self._node_values
        owned = np.zeros(0, np.int32)
        if self.mesh_map is not None:
            owned = rows.find(np.asarray(self.mesh_map)).astype(np.int32)
        edges = np.ascontiguousarray(self._row_edges(), np.int32)
        return _core.Graph(np.ascontiguousarray(rows.vertices), edges, values, owned)

    @property
    def edges(self) -> np.ndarray:
        """(m, 2) node ids, child and parent; the edges at which loops are cut come last."""
        return self._rows().ids[self._row_edges()]

    @property
    def vertices(self) -> np.ndarray:
        """(n, 3) positions of the nodes."""
        return self._rows().vertices

    def __len__(self) -> int:
        return len(self._rows().ids)

    def __repr__(self) -> str:
        return (
            f"<Skeleton(vertices={self.vertices.shape}, edges={self.edges.shape}, "
            f"cycles={len(self._cut)}, method={self.method})>"
        )

    def copy(self) -> Skeleton:
        """A skeleton of its own; the mesh and what the run left behind are shared, as nothing changes them."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other._vertices, other._radii = self._vertices.copy(), self._radii.copy()
        other._parents, other._cut = self._parents.copy(), self._cut.copy()
        other._table = None if self._table is None else self._table.copy()
        other.mesh_map = None if self.mesh_map is None else np.array(self.mesh_map)
        return other

    clone = copy

    def __getstate__(self) -> dict:
        """For pickle and Dask: the skeleton with its mesh; what lies between the stages stays behind."""
        state = self.__dict__.copy()
        state["_extraction"] = None
        if isinstance(self._source, MeshInput):
            state["_source"] = self._mesh_arrays()
        return state


def read_skeleton(path: str | os.PathLike) -> Skeleton:
    """A skeleton from .skel, .obj, .ply, .json, .swc, .cgal or .polylines.txt. Raises ReadError, and UsageError for another extension."""
    return Skeleton.of_graph(_core.read_skeleton(os.fspath(path)), method=os.fspath(path))
