"""The names of skeletor's Skeleton."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import networkx
    import pandas
    import trimesh

    from .skeleton import Skeleton


class SkeletorNames:
    """A tree as a table; pandas, networkx and trimesh are imported when they are needed."""

    @property
    def swc(self) -> pandas.DataFrame:
        """node_id, parent_id, x, y, z, radius; a root's parent is -1. The table may be changed."""
        if self._table is None:
            import pandas

            table = pandas.DataFrame(self._vertices, columns=["x", "y", "z"])
            table.insert(0, "parent_id", self._parents)
            table.insert(0, "node_id", np.arange(len(table)))
            table["radius"] = self._radii
            self._table = table
        return self._table

    @swc.setter
    def swc(self, table: pandas.DataFrame) -> None:
        self._table = table

    @property
    def radius(self) -> np.ndarray:
        """(n,) distance of the nodes to the surface."""
        return self._rows().radii

    @property
    def mesh(self) -> trimesh.Trimesh | None:
        """The mesh that the skeleton was made from, as it was given; as a trimesh unless it was one."""
        source = getattr(self._source, "source", self._source)
        if source is None or (hasattr(source, "faces") and hasattr(source, "edges")):
            return source
        import trimesh

        vertices, faces = self._mesh_arrays()
        self._source = trimesh.Trimesh(vertices, faces, process=False)
        return self._source

    @mesh.setter
    def mesh(self, mesh: Any) -> None:
        self._source = mesh

    def _mesh_arrays(self) -> tuple[np.ndarray, np.ndarray]:
        soup = getattr(self._source, "soup", None)
        if soup is None:
            if isinstance(self._source, tuple):
                return self._source
            return np.asarray(self._source.vertices), np.asarray(self._source.faces)
        offsets, corners = np.asarray(soup.offsets), np.asarray(soup.corners)
        if (np.diff(offsets) == 3).all():
            return np.asarray(soup.points), corners.reshape(-1, 3)
        fans = [[corners[a], corners[k], corners[k + 1]] for a, b in zip(offsets, offsets[1:]) for k in range(a + 1, b - 1)]
        return np.asarray(soup.points), np.array(fans).reshape(-1, 3)

    @property
    def skel_map(self) -> list[np.ndarray] | None:
        """Per node the vertices of the mesh that map to it."""
        if self.mesh_map is None:
            return None
        owner = self._rows().find(np.asarray(self.mesh_map))
        order = np.argsort(owner, kind="stable")
        ends = np.searchsorted(owner[order], np.arange(len(self) + 1))
        return [order[a:b] for a, b in zip(ends, ends[1:])]

    @property
    def roots(self) -> np.ndarray:
        """Index of the roots."""
        return self._rows().roots()

    @property
    def leafs(self) -> pandas.DataFrame:
        """The rows of leaves and roots."""
        table, rows = self.swc, self._rows()
        return table[(rows.child_counts() == 0) | (rows.parents < 0)].copy()

    @property
    def skeleton(self) -> Any:
        """A trimesh Path3D with one line an edge."""
        from trimesh.path import Path3D
        from trimesh.path.entities import Line

        return Path3D([Line(edge) for edge in self._row_edges()], vertices=self.vertices.copy(), process=False)

    def get_graph(self) -> networkx.DiGraph:
        """The trees as a graph from child to parent, ``weight`` the length of an edge."""
        import networkx

        rows = self._rows()
        ids, lengths = rows.ids, rows.lengths()
        graph = networkx.DiGraph()
        graph.add_nodes_from(ids.tolist())
        children = np.flatnonzero(rows.parents >= 0)
        ends = zip(ids[children].tolist(), ids[rows.parents[children]].tolist(), lengths[children].tolist())
        graph.add_weighted_edges_from(ends)
        return graph

    def get_segments(self, weight: str | None = "weight", return_lengths: bool = False) -> Any:
        """Paths of node ids from the leaves rootward, the longest first, each to the first node of an earlier one.

        weight "weight" measures by length, None by nodes. With return_lengths the lengths come second.
        """
        if weight not in ("weight", None):
            raise ValueError(f'weight: expected "weight" or None, not {weight!r}')
        rows = self._rows()
        lengths = rows.lengths() if weight else np.where(rows.parents >= 0, 1.0, 0.0)
        distance = rows.distances_to_root(lengths)
        leaves = np.flatnonzero((rows.child_counts() == 0) & (rows.parents >= 0))
        seen: set[int] = set()
        segments = []
        for leaf in sorted(leaves.tolist(), key=lambda row: -distance[row]):
            path = []
            for row in rows.way_to_root(leaf):
                path.append(row)
                if row in seen:
                    break
                seen.add(row)
            segments.append((float(distance[path[0]] - distance[path[-1]]), rows.ids[path].tolist()))
        segments.sort(reverse=True)
        paths = [path for _, path in segments]
        return (paths, [length for length, _ in segments]) if return_lengths else paths

    def reindex(self, inplace: bool = False) -> Skeleton | None:
        """Numbers the nodes from 0 on, parents first."""
        result = self if inplace else self.copy()
        rows = result._rows()
        order = np.array(rows.parents_first(), int)
        place = np.empty(len(order) + 1, int)
        place[order] = np.arange(len(order))
        place[-1] = -1
        table = result.swc.iloc[order].reset_index(drop=True)
        table["node_id"] = np.arange(len(order))
        table["parent_id"] = place[rows.parents[order]]
        result._cut = place[rows.find_pairs(result._cut)]
        if result.mesh_map is not None:
            result.mesh_map = place[rows.find(np.asarray(result.mesh_map))]
        if len(result._node_values) == len(order):
            result._node_values = result._node_values[order]
        result._table = table
        return None if inplace else result

    def reroot(self, new_root: int) -> Skeleton:
        """The skeleton with another root in the tree of that node, an index of ``swc``."""
        result = self.copy()
        table = result.swc
        if new_root not in table.index:
            raise ValueError(f"node {new_root} is not in the skeleton")
        rows = result._rows()
        way = list(rows.way_to_root(table.index.get_loc(new_root)))
        parents = table["parent_id"].to_numpy().copy()
        parents[way[0]] = -1
        parents[way[1:]] = rows.ids[way[:-1]]
        table["parent_id"] = parents
        return result

    def save_swc(self, filepath: str | os.PathLike) -> None:
        """Writes the trees as SWC, with labels 5 for forks and 6 for ends."""
        from . import _core

        _core.write_file(os.fspath(filepath), self.to_swc().encode())

    def scene(self, mesh: bool = False, **keywords: Any) -> trimesh.Scene:
        """A trimesh scene of the skeleton, with the mesh as glass if asked for."""
        import trimesh

        shown = [self.skeleton]
        if mesh:
            if self.mesh is None:
                raise ValueError("the skeleton has no mesh")
            vertices, faces = self._mesh_arrays()
            glass = trimesh.Trimesh(vertices, faces, process=False)
            glass.visual.face_colors = [100, 100, 100, 100]
            shown.insert(0, glass)
        return trimesh.Scene(shown, **keywords)

    def show(self, mesh: bool = False, **keywords: Any) -> Any:
        """Shows the scene in a window of trimesh's viewer, scaled to its usual size."""
        scene = self.scene(mesh=mesh)
        size = 5 / np.abs(self.vertices).max()
        scene.apply_transform(np.diag([size, size, size, 1]))
        return scene.show(**keywords)

    def mend_breaks(
        self, dist_mult: float = 5, dist_min: float = 0, dist_max: float = np.inf
    ) -> tuple[np.ndarray, np.ndarray]:
        """Edges and vertices, with edges added where the mesh joins nodes that are far apart along the skeleton.

        An edge of the mesh joins the nodes of its ends if their distance is from dist_min to dist_max and the way
        between them is longer than dist_mult times that; the shortest are added first.
        """
        if self.mesh_map is None or self._source is None:
            raise ValueError("to mend breaks takes a mesh and a mesh_map")
        import networkx

        graph = self.get_graph().to_undirected()
        graph.add_nodes_from(self._rows().ids.tolist())
        place = {node: x for node, x in zip(self._rows().ids.tolist(), self.vertices)}
        for length, a, b in sorted(self._node_pairs_of_mesh(place)):
            if not dist_min <= length <= dist_max:
                continue
            near = networkx.single_source_dijkstra_path_length(graph, a, cutoff=dist_mult * length)
            if b not in near:
                graph.add_edge(a, b, weight=length)
        return np.array(graph.edges), self.vertices.copy()

    def _node_pairs_of_mesh(self, place: dict[int, np.ndarray]) -> set[tuple[float, int, int]]:
        faces = self._mesh_arrays()[1]
        ends = np.asarray(self.mesh_map)[np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])]
        pairs = np.unique(np.sort(ends, axis=1), axis=0).tolist()
        return {(float(np.linalg.norm(place[a] - place[b])), a, b) for a, b in pairs if a != b and a in place and b in place}
