"""The names of MeshParty's Skeleton, where skeletor and osteoid have not taken them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import scipy.sparse


class MeshPartyNames:
    """Trees by row; the root of the first one is the root."""

    @property
    def n_vertices(self) -> int:
        """Number of nodes."""
        return len(self)

    @property
    def root(self) -> int:
        """The first root."""
        return int(self._rows().roots()[0])

    @property
    def root_position(self) -> np.ndarray:
        """Where the first root is."""
        return self.vertices[self.root]

    @property
    def mesh_to_skel_map(self) -> np.ndarray | None:
        """Per vertex of the mesh its node."""
        return self.mesh_map

    @property
    def end_points(self) -> np.ndarray:
        """Nodes without children."""
        return np.flatnonzero(self._rows().child_counts() == 0)

    @property
    def branch_points(self) -> np.ndarray:
        """Nodes with two children or more."""
        return np.flatnonzero(self._rows().child_counts() > 1)

    @property
    def segments(self) -> list[np.ndarray]:
        """Runs of nodes rootward, from an end or a branch point to before the next branch point; each node is in one."""
        rows = self._rows()
        forks = rows.child_counts() > 1
        result = []
        for first in np.concatenate([self.end_points, self.branch_points]).tolist():
            run = [first]
            for row in list(rows.way_to_root(first))[1:]:
                if forks[row]:
                    break
                run.append(row)
            result.append(np.array(run))
        return result

    @property
    def segment_map(self) -> np.ndarray:
        """Per node its segment."""
        result = np.full(len(self), -1)
        for number, segment in enumerate(self.segments):
            result[segment] = number
        return result

    def path_to_root(self, v_ind: int) -> np.ndarray:
        """The node and those on its way to the root."""
        return np.array(list(self._rows().way_to_root(v_ind)))

    @property
    def distance_to_root(self) -> np.ndarray:
        """Per node the length of its way to the root."""
        rows = self._rows()
        return rows.distances_to_root(rows.lengths())

    @property
    def csgraph(self) -> scipy.sparse.csr_matrix:
        """Lengths of the trees' edges, from child to parent."""
        from scipy.sparse import csr_matrix

        rows = self._rows()
        children = np.flatnonzero(rows.parents >= 0)
        size = len(rows.ids)
        return csr_matrix((rows.lengths()[children], (children, rows.parents[children])), shape=(size, size))
