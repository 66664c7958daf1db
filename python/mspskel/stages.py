"""The stages one by one, as in C++, so that others can be put between them.

    surface = stages.surface(mesh)                      # mended, in its normalised frame
    slices = stages.slices(surface)                     # minimum slices (MSP) and their errors
    points = stages.skeletal_points(surface, slices)    # every vertex at the centre of its slice
    cocycles = stages.cocycles(surface, slices)         # what tells the ways round handles
    collapsed = stages.collapse(surface, points, cocycles)
    tips = stages.limb_tips(surface, slices)
    arcs = stages.arcs(collapsed, cocycles)
    stages.refine(arcs, surface, slices, tips)          # routed inside, pruned, centred, led to the tips
    skeleton = stages.finish(arcs, surface, points)

Lengths are in the surface's frame; ``surface.to_model(points)`` leads back. Arrays of slices and points are read-only views;
assign another array of the same length to replace one. On a surface of one component this gives what ``skeletonize(mesh,
coarsen=False)`` gives, to the last bit. Every function takes ``options=`` and the options' names as ``skeletonize`` does.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from .input import read_mesh
from .options import Options, merged
from .skeleton import Skeleton

Surface = _core.Surface
Slices = _core.Slices
SkeletonMesh = _core.SkeletonMesh
Cocycles = _core.Cocycles
Collapsed = _core.Collapsed
LimbTips = _core.LimbTips
Arcs = _core.Arcs


def surface(mesh: Any, *, options: Options | None = None, **keywords: Any) -> Surface:
    """The closed surface of a mesh, mended where need be."""
    return _core.make_surface(read_mesh(mesh).soup, merged(options, keywords)._core)


def coarsen(surface: Surface, *, options: Options | None = None, **keywords: Any) -> tuple[Surface, np.ndarray]:
    """A surface of ``coarse_vertices``, and per vertex the one that it merged into."""
    return _core.coarsen(surface, merged(options, keywords)._core)


def slices(surface: Surface, *, options: Options | None = None, **keywords: Any) -> Slices:
    """Minimum slices and their errors, by search or, with ``slice_method="sampling"``, by sampling and cones."""
    wanted = merged(options, keywords)
    found = minimum_slices(surface, options=wanted)
    slice_errors(surface, found, options=wanted)
    values = wanted.values
    if values["slice-method"] == "sampling" and values["cone"]:
        refine_slices(surface, found, options=wanted)
        slice_errors(surface, found, options=wanted)
    return found


def minimum_slices(surface: Surface, *, options: Options | None = None, **keywords: Any) -> Slices:
    """The MSP function alone; errors are not known yet."""
    return _core.slices(surface, merged(options, keywords)._core)


def slice_errors(surface: Surface, slices: Slices, *, options: Options | None = None, **keywords: Any) -> None:
    """Fills in errors, areas and centres of the slices."""
    _core.slice_errors(surface, slices, merged(options, keywords)._core)


def refine_slices(surface: Surface, slices: Slices, *, options: Options | None = None, **keywords: Any) -> None:
    """Cone refinement: more planes where the error is high. Errors are those of before."""
    _core.refine_slices(surface, slices, merged(options, keywords)._core)


def skeletal_points(
    surface: Surface, slices: Slices, *, options: Options | None = None, **keywords: Any
) -> SkeletonMesh:
    """Every vertex at its skeletal point, made coherent unless ``coherence=False``."""
    return _core.skeletal_points(surface, slices, merged(options, keywords)._core)


def cocycles(surface: Surface, slices: Slices, *, options: Options | None = None, **keywords: Any) -> Cocycles:
    """What tells the ways round handles, for the collapse."""
    return _core.cocycles(surface, slices, merged(options, keywords)._core)


def collapse(
    surface: Surface,
    points: SkeletonMesh,
    cocycles: Cocycles,
    *,
    options: Options | None = None,
    **keywords: Any,
) -> Collapsed:
    """The skeleton mesh collapsed to a graph."""
    return _core.collapse(surface, points, cocycles, merged(options, keywords)._core)


def limb_tips(surface: Surface, slices: Slices, *, options: Options | None = None, **keywords: Any) -> LimbTips:
    """Where the limbs of the surface end."""
    return _core.limb_tips(surface, slices, merged(options, keywords)._core)


def arcs(collapsed: Collapsed, cocycles: Cocycles) -> Arcs:
    """Hubs and arcs of the collapsed graph."""
    return _core.arcs(collapsed, cocycles)


def refine(
    arcs: Arcs,
    surface: Surface,
    slices: Slices,
    tips: LimbTips,
    *,
    options: Options | None = None,
    **keywords: Any,
) -> None:
    """Leads the arcs inside, prunes, zips and centres them, and leads them to the tips and into digits."""
    _core.refine_arcs(arcs, surface, slices, tips, merged(options, keywords)._core)


def finish(
    arcs: Arcs, surface: Surface, points: SkeletonMesh, *, options: Options | None = None, **keywords: Any
) -> Skeleton:
    """The skeleton that the arcs are, with radii and the map of the surface's vertices."""
    graph = _core.finish(arcs, surface, points, merged(options, keywords)._core)
    mesh = (surface.to_model(surface.points), surface.faces)
    return Skeleton.of_graph(graph, source=mesh, method="mspskel stages")
