"""The keyword arguments of skeletonize, for type checkers: the command line's options."""

from __future__ import annotations

from typing import TypedDict, Union


class OptionKeywords(TypedDict, total=False):
    """``mspskel --help-all`` says what they mean, and so does ``mspskel.options.describe()``."""

    for_: str
    mode: str
    threads: float
    seed: float
    time_limit: float
    least_inside: float
    keep_failed: bool
    repair: Union[bool, str]
    components: Union[float, str]
    weld: float
    open: str
    wrap: Union[float, str]
    shells: str
    coarsen: bool
    coarse_vertices: float
    limb_vertices: float
    slice_method: str
    slices: float
    search_spread: float
    search_rounds: float
    search_tilt: float
    cone: bool
    cone_threshold: float
    cone_directions: float
    cone_min_angle: float
    cone_max_angle: float
    error_average: str
    error_scale: str
    point: str
    holes: str
    moving_samples: float
    force_samples: float
    displacement: float
    force_step: float
    merge_radius: float
    starts: float
    coherence: bool
    coherence_strength: float
    lambda_: float
    saturation: float
    bare_edges: str
    angle_floor: float
    order: str
    keep_topology: bool
    smallest_handle: float
    filter: bool
    filter_ball: float
    refine: bool
    step: float
    nodes: float
    detail: float
    smallest: float
    centring_rounds: float
    smoothness: float
    tip_clearance: float
    joint_overlap: float
