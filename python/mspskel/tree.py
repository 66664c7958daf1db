"""Trees as rows of nodes with their parents, and questions about them that several packages' names ask."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator

import numpy as np


@dataclass
class Rows:
    """Nodes in any order; parents are rows, -1 for roots."""

    ids: np.ndarray
    vertices: np.ndarray
    radii: np.ndarray
    parents: np.ndarray

    def find(self, ids: np.ndarray) -> np.ndarray:
        """The rows of nodes, -1 for a node that is not there."""
        if len(self.ids) == 0:
            return np.full(np.shape(ids), -1)
        order = np.argsort(self.ids, kind="stable")
        at = np.minimum(np.searchsorted(self.ids, ids, sorter=order), len(self.ids) - 1)
        return np.where(self.ids[order[at]] == ids, order[at], -1)

    def find_pairs(self, pairs: np.ndarray) -> np.ndarray:
        """The rows of pairs of nodes, both of which are there."""
        found = self.find(pairs).reshape(-1, 2)
        return found[(found >= 0).all(axis=1)]

    def roots(self) -> np.ndarray:
        """Rows without a parent."""
        return np.flatnonzero(self.parents < 0)

    def child_counts(self) -> np.ndarray:
        """Per row the number of its children."""
        return np.bincount(self.parents[self.parents >= 0], minlength=len(self.parents))

    def parents_first(self) -> list[int]:
        """All rows, each after its parent."""
        children: list[list[int]] = [[] for _ in self.parents]
        for row, parent in enumerate(self.parents):
            if parent >= 0:
                children[parent].append(row)
        order = list(self.roots())
        for row in order:
            order.extend(children[row])
        return [int(row) for row in order]

    def way_to_root(self, row: int) -> Iterator[int]:
        """The row, its parent, and so on to its root."""
        while row >= 0:
            yield int(row)
            row = self.parents[row]

    def lengths(self) -> np.ndarray:
        """Per row the length of the edge to its parent, 0 at roots."""
        steps = self.vertices - self.vertices[np.maximum(self.parents, 0)]
        return np.where(self.parents >= 0, np.linalg.norm(steps, axis=1), 0.0)

    def distances_to_root(self, lengths: np.ndarray) -> np.ndarray:
        """Per row the sum of `lengths` on its way to the root."""
        distances = np.zeros(len(self.parents))
        for row in self.parents_first():
            if self.parents[row] >= 0:
                distances[row] = distances[self.parents[row]] + lengths[row]
        return distances

    def path_between(self, a: int, b: int) -> list[int]:
        """The rows from a to b, both included, in one tree."""
        up, down = list(self.way_to_root(a)), list(self.way_to_root(b))
        while len(up) > 1 and len(down) > 1 and up[-2:] == down[-2:]:
            up.pop()
            down.pop()
        if up[-1] == down[-1]:
            meets_below = {row: i for i, row in enumerate(up)}
            for j, row in enumerate(down):
                if row in meets_below:
                    return up[: meets_below[row] + 1] + down[:j][::-1]
        return []


def rows_of_table(table: Any) -> Rows:
    """The rows of a table with node_id, parent_id, x, y, z and perhaps radius."""
    ids = table["node_id"].to_numpy()
    radii = table["radius"].to_numpy(float) if "radius" in table.columns else np.zeros(len(ids))
    rows = Rows(ids, table[["x", "y", "z"]].to_numpy(float), radii, np.full(len(ids), -1))
    rows.parents = rows.find(table["parent_id"].to_numpy())
    return rows
