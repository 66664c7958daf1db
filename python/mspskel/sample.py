"""Closed meshes whose skeletons are known."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core


def sample(name: str = "quadruped", **settings: Any) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and faces of a sample; settings are resolution, jitter, seed, count, ratio.

    Raises UsageError for another name, with the nearest one.
    """
    soup = _core.make_sample(name, **settings)
    return np.asarray(soup.points), np.asarray(soup.corners).reshape(-1, 3)


def sample_names() -> list[str]:
    """The names that sample() knows."""
    return _core.sample_names()
