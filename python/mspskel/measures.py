"""What is known of a skeleton beyond its shape: cycles, certificate, coverage, checks, what lies between the stages."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from . import _core
from .errors import UsageError
from .run_stages import RunStages


class Measures:
    """Answers that take the run are there for what ``skeletonize`` returned and its copies, not after pickling."""

    def _run(self) -> _core.Extraction:
        if self._extraction is None:
            raise UsageError("this skeleton does not come from skeletonize, which alone knows its surface")
        return self._extraction

    @property
    def cycles(self) -> list[np.ndarray]:
        """Nodes of a loop for each independent cycle, in order round it."""
        rows = self._rows()
        return [np.array(rows.path_between(a, b)) for a, b in rows.find_pairs(self._cut).tolist()]

    @property
    def certificate(self) -> dict[str, Any]:
        """Whether pieces and cycles are the solid's, and why ("proved", "kept" or "failed"), as in reports."""
        return json.loads(self._run().certificate())

    @property
    def coverage(self) -> dict[str, float]:
        """Mean and 95th percentile of the surface's distance to the skeleton's balls, in diagonals of the mesh."""
        checks = self.check()
        return {"mean": checks["cover_mean"], "p95": checks["cover_p95"]}

    def check(self) -> dict[str, Any]:
        """The figures of ``mspskel check`` for the skeleton as it is: topology, containment, centredness, and so on."""
        return json.loads(self._run().check(self._graph()))

    @property
    def report(self) -> dict[str, Any]:
        """What ``--report`` writes: input, repair, options, counts, seconds, checks, warnings."""
        return json.loads(self._run().report())

    @property
    def stages(self) -> RunStages:
        """What lies between the stages, as arrays."""
        return RunStages(self._run())

    @property
    def node_values(self) -> dict[str, np.ndarray]:
        """Per node: surface area that maps to it, mean MSP and mean slice error of that."""
        return dict(zip(("area", "perimeter", "slice_error"), self._node_values.T))
