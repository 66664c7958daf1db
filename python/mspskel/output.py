"""The skeleton as files, pages and pictures."""

from __future__ import annotations

import html
import os
from typing import Any

from . import _core


class Output:
    """Every format of the command line, by extension."""

    def to(self, path: str | os.PathLike) -> str:
        """Writes the file whole or not at all, and returns its path.

        .skel .obj .ply .json .swc .vtp .graphml .cgal .polylines.txt, .glb with the surface (rigged: ``rig().to``), and
        .html for a page to look at. The bytes are the command line's. Raises UsageError for another extension, WriteError.
        """
        path = os.fspath(path)
        _core.write_file(path, self.to_bytes(path))
        return path

    def to_bytes(self, name: str) -> bytes:
        """The bytes of a file of that name."""
        if name.lower().endswith((".html", ".htm")):
            return self._run().page()
        if name.lower().endswith(".glb"):
            return self._run().glb()
        report = ""
        if name.lower().endswith(".json") and self._extraction is not None:
            report = self._extraction.facts()
        return _core.format_skeleton(self._graph(), name, report)

    def _repr_html_(self) -> str | None:
        if self._extraction is None:
            return None
        page = html.escape(self._extraction.page().decode())
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 600px; border: 0"></iframe>'

    def plot(self, mesh: bool = True, **keywords: Any) -> Any:
        """Draws the skeleton, and the mesh as glass, with pyvista or else matplotlib; returns plotter or axes.

        Keywords go to pyvista's Plotter or to matplotlib's figure.
        """
        try:
            import pyvista
        except ImportError:
            return self._plot_matplotlib(mesh, **keywords)
        import numpy as np

        plotter = pyvista.Plotter(**keywords)
        edges = self._row_edges()
        lines = np.insert(edges, 0, 2, axis=1).ravel()
        plotter.add_mesh(pyvista.PolyData(self.vertices, lines=lines), color="crimson", line_width=4)
        if mesh and self._source is not None:
            vertices, faces = self._mesh_arrays()
            glass = pyvista.PolyData.from_regular_faces(vertices, faces)
            plotter.add_mesh(glass, color="lightgrey", opacity=0.3)
        return plotter

    def _plot_matplotlib(self, mesh: bool, **keywords: Any) -> Any:
        from matplotlib import pyplot
        from mpl_toolkits.mplot3d.art3d import Line3DCollection

        axes = pyplot.figure(**keywords).add_subplot(projection="3d")
        if mesh and self._source is not None:
            vertices, faces = self._mesh_arrays()
            axes.plot_trisurf(*vertices.T, triangles=faces, color="lightgrey", alpha=0.2)
        axes.add_collection3d(Line3DCollection(self.vertices[self._row_edges()], colors="crimson"))
        axes.auto_scale_xyz(*self.vertices.T)
        axes.set_aspect("equal")
        return axes
