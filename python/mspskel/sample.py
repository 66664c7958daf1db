"""Closed meshes whose skeletons are known."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from .skeleton import Skeleton


def sample(name: str = "quadruped", **settings: Any) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and faces of a sample; settings are resolution, jitter, seed, count, ratio, sides, section, sparse.

    Raises UsageError for another name, with the nearest one.
    """
    soup = _core.make_sample(name, **settings)
    return np.asarray(soup.points), np.asarray(soup.corners).reshape(-1, 3)


def sample_truth(name: str = "quadruped", **settings: Any) -> Skeleton:
    """The skeleton that sample() with the same settings is made round.

    Raises UsageError where none is defined, as for a plate or a ball.
    """
    return Skeleton.of_graph(_core.sample_truth(name, **settings), method=f"sample {name}")


def sample_names() -> list[str]:
    """The names that sample() knows."""
    return _core.sample_names()
