"""Curve skeletons of triangle meshes by minimum slice perimeter.

    import mspskel
    skeleton = mspskel.skeletonize("mesh.off")
    skeleton.to("mesh.swc")
"""

import os as _os

# GNU's OpenMP, which comes with the extension, reads this once when it is loaded: threads that wait for work sleep, so that
# several Python threads share the cores.
_policy = "OMP_WAIT_POLICY"
_lent = _policy not in _os.environ and "GOMP_SPINCOUNT" not in _os.environ
if _lent:
    _os.environ[_policy] = "passive"
try:
    from ._core import version as __version__
finally:
    if _lent:
        del _os.environ[_policy]

from . import stages  # noqa: E402
from .engine import skeletonize  # noqa: E402
from .errors import (  # noqa: E402
    Cancelled,
    Error,
    MeshError,
    NoSkeletonError,
    ReadError,
    SkeletonWarning,
    UsageError,
    WriteError,
)
from .options import Options  # noqa: E402
from .sample import sample, sample_names, sample_truth  # noqa: E402
from .skeleton import Skeleton, read_skeleton  # noqa: E402

__all__ = [
    "Cancelled",
    "Error",
    "MeshError",
    "NoSkeletonError",
    "Options",
    "ReadError",
    "Skeleton",
    "SkeletonWarning",
    "UsageError",
    "WriteError",
    "__version__",
    "read_skeleton",
    "sample",
    "sample_names",
    "sample_truth",
    "skeletonize",
    "stages",
]
