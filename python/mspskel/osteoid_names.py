"""The names of osteoid's Skeleton, which is kimimaro's and cloud-volume's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .errors import ReadError

if TYPE_CHECKING:
    import networkx

    from .skeleton import Skeleton


class OsteoidNames:
    """The skeleton as a graph, loops included."""

    @property
    def radii(self) -> np.ndarray:
        """(n,) distance of the nodes to the surface."""
        return self._rows().radii

    @property
    def vertex_types(self) -> np.ndarray:
        """(n,) SWC types: 0, undefined."""
        return np.zeros(len(self), np.uint8)

    def _degrees(self) -> np.ndarray:
        return np.bincount(self._row_edges().ravel(), minlength=len(self))

    def terminals(self) -> np.ndarray:
        """Nodes with one neighbour."""
        return np.flatnonzero(self._degrees() == 1)

    def branches(self) -> np.ndarray:
        """Nodes with three neighbours or more."""
        return np.flatnonzero(self._degrees() > 2)

    def paths(self, return_indices: bool = False) -> list[np.ndarray]:
        """Ways from the root to every leaf of the trees, as positions or nodes."""
        rows = self._rows()
        leaves = np.flatnonzero((rows.child_counts() == 0) & (rows.parents >= 0))
        return self._as_paths([list(rows.way_to_root(leaf))[::-1] for leaf in leaves], return_indices)

    def interjoint_paths(self, return_indices: bool = False) -> list[np.ndarray]:
        """Branches: maximal chains between joints and ends, as positions or nodes; every edge is in one."""
        return self._as_paths(self._graph().branches(), return_indices)

    def _as_paths(self, chains: list, return_indices: bool) -> list[np.ndarray]:
        indices = [np.asarray(chain, dtype=np.int64) for chain in chains]
        return indices if return_indices else [self.vertices[chain] for chain in indices]

    def components(self) -> list[Skeleton]:
        """The pieces, each as a skeleton without mesh."""
        rows, edges = self._rows(), self._row_edges()
        piece = np.arange(len(rows.ids))
        for row in rows.parents_first():
            if rows.parents[row] >= 0:
                piece[row] = piece[rows.parents[row]]
        return [self._part(np.flatnonzero(piece == root), edges) for root in rows.roots()]

    def _part(self, kept: np.ndarray, edges: np.ndarray) -> Skeleton:
        place = np.full(len(self) + 1, -1)
        place[kept] = np.arange(len(kept))
        renamed = place[edges]
        renamed = renamed[(renamed >= 0).all(axis=1)]
        return type(self)(self.vertices[kept], renamed, self.radii[kept], method=self.method)

    def cable_length(self) -> float:
        """Sum of the lengths of all edges."""
        ends = self.vertices[self._row_edges()]
        return float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum())

    def downsample(self, factor: int) -> Skeleton:
        """Every factor-th node along each branch; joints, ends, and a loop's shape as a loop stay."""
        if factor != int(factor) or factor < 1:
            raise ValueError(f"factor: expected a whole number of at least 1, not {factor}")
        edges = [_strided(chain, int(factor)) for chain in self.interjoint_paths(return_indices=True)]
        pairs = np.concatenate([np.column_stack([c[:-1], c[1:]]) for c in edges] or [np.zeros((0, 2), int)])
        isolated = np.flatnonzero(self._degrees() == 0)
        return self._part(np.unique(np.concatenate([pairs.ravel(), isolated]).astype(int)), pairs.astype(int))

    def to_swc(self, contributors: str = "") -> str:
        """The trees as text: label 5 at forks, 6 at ends; loops are cut, the cut edges are comments."""
        rows = self._rows()
        order = rows.parents_first()
        number = {row: i + 1 for i, row in enumerate(order)}
        children = rows.child_counts()
        lines = [f"# ORIGINAL_SOURCE {self.method}"] + ([f"# CONTRIBUTOR {contributors}"] if contributors else [])
        lines += [f"# cut edge {number[a]} {number[b]}" for a, b in rows.find_pairs(self._cut).tolist()]
        for row in order:
            label = 6 if children[row] == 0 else 5 if children[row] > 1 else 0
            numbers = " ".join(repr(float(x)) for x in (*rows.vertices[row], rows.radii[row]))
            lines.append(f"{number[row]} {label} {numbers} {number.get(int(rows.parents[row]), -1)}")
        return "\n".join(lines) + "\n"

    def to_precomputed(self) -> bytes:
        """Neuroglancer's bytes: counts, float32 positions, edges, float32 radii, uint8 types."""
        edges = self._row_edges()
        return b"".join(
            values.tobytes()
            for values in (
                np.array([len(self), len(edges)], "<u4"),
                self.vertices.astype("<f4"),
                edges.astype("<u4"),
                self.radii.astype("<f4"),
                self.vertex_types,
            )
        )

    @classmethod
    def from_precomputed(cls, skelbuf: bytes, segid: Any = None, vertex_attributes: Any = None) -> Skeleton:
        """The skeleton of such bytes; radii may be absent. Raises ReadError for bytes that are none.

        Attributes after the radii are read over, whatever ``vertex_attributes`` says.
        """
        if len(skelbuf) < 8:
            raise ReadError("precomputed skeleton: shorter than its header of 8 bytes")
        nodes, pairs = (int(n) for n in np.frombuffer(skelbuf, "<u4", 2))
        least = 8 + 12 * nodes + 8 * pairs
        if len(skelbuf) < least:
            raise ReadError(f"precomputed skeleton: {len(skelbuf)} bytes, of at least {least} that it announces")
        vertices = np.frombuffer(skelbuf, "<f4", 3 * nodes, 8).reshape(-1, 3)
        edges = np.frombuffer(skelbuf, "<u4", 2 * pairs, 8 + 12 * nodes).reshape(-1, 2)
        has_radii = len(skelbuf) >= least + 4 * nodes
        radii = np.frombuffer(skelbuf, "<f4", nodes, least) if has_radii else None
        skeleton = cls(vertices, edges, radii, method="precomputed")
        skeleton.id = segid
        return skeleton

    def to_networkx(self) -> networkx.Graph:
        """All nodes and edges as an undirected graph, loops included."""
        import networkx

        graph = networkx.Graph()
        graph.add_nodes_from(range(len(self)))
        graph.add_edges_from(self._row_edges().tolist())
        return graph

    def empty(self) -> bool:
        """Whether there is no node."""
        return len(self) == 0


def _strided(chain: np.ndarray, factor: int) -> np.ndarray:
    kept = np.append(chain[:-1:factor], chain[-1])
    if chain[0] == chain[-1] and len(kept) < 4:  # a loop without joints keeps three nodes
        return chain[[0, len(chain) // 3, 2 * len(chain) // 3, -1]]
    return kept
