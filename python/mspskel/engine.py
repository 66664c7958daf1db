"""From a mesh to its skeleton."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

from . import _core
from .errors import SkeletonWarning
from .input import read_mesh
from .options import Options, merged
from .progress import Progress, reporter
from .skeleton import Skeleton

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .keywords import OptionKeywords


def skeletonize(
    mesh: Any,
    /,
    *,
    options: Options | None = None,
    progress: Progress = None,
    **keywords: Unpack[OptionKeywords],
) -> Skeleton:
    """The curve skeleton of a mesh, the same to the last bit as the command line's.

    mesh      a path, (vertices, faces), or a mesh of trimesh, navis, open3d, pyvista, VTK or meshio; what is
              not closed is mended as the command line does it
    options   an Options; keywords are single ones, with the command line's names: ``smallest=0.004``
    progress  called with a stage's name and the share done (to return False cancels), or True for a bar

    Other Python threads run meanwhile; Ctrl-C ends it. Warnings are SkeletonWarnings. Raises ReadError,
    MeshError, UsageError, NoSkeletonError, Cancelled. Cost: that of the command line; vertices and faces are
    copied once.
    """
    given = read_mesh(mesh)
    wanted = merged(options, keywords)
    with reporter(progress) as callback:
        extraction = _core.extract(given.soup, given.name, wanted._core, callback)
    for warning in extraction.warnings:
        warnings.warn(warning, SkeletonWarning, stacklevel=2)
    return Skeleton.of_extraction(extraction, given)
