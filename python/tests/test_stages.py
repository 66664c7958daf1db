"""The stages one by one, and what a run keeps of them."""

import numpy as np
import pytest

import mspskel
from mspskel import stages


def compose(mesh, **options):
    surface = stages.surface(mesh)
    slices = stages.slices(surface, **options)
    points = stages.skeletal_points(surface, slices, **options)
    cocycles = stages.cocycles(surface, slices, **options)
    collapsed = stages.collapse(surface, points, cocycles, **options)
    tips = stages.limb_tips(surface, slices, **options)
    arcs = stages.arcs(collapsed, cocycles)
    stages.refine(arcs, surface, slices, tips, **options)
    return stages.finish(arcs, surface, points, **options)


@pytest.mark.parametrize("name", ["quadruped", "torus"])
def test_the_composition_is_skeletonize(name):
    mesh = mspskel.sample(name)
    whole = mspskel.skeletonize(mesh, coarsen=False)
    steps = compose(mesh, coarsen=False)
    assert np.array_equal(steps.vertices, whole.vertices) and np.array_equal(steps.edges, whole.edges)
    assert np.array_equal(steps.radii, whole.radii) and np.array_equal(steps.mesh_map, whole.mesh_map)


def test_slices_are_closed_plane_curves_of_their_length(torus):
    surface = stages.surface(torus)
    slices = stages.slices(surface)
    assert slices.valid.all() and (slices.error >= 0).all() and (slices.error <= 1).all()
    for vertex in (0, 100, 400):
        contour = surface.contour(slices, vertex)
        length = np.linalg.norm(contour - np.roll(contour, 1, axis=0), axis=1).sum()
        assert length == pytest.approx(slices.perimeter[vertex])
        assert abs((contour - surface.points[vertex]) @ slices.normal[vertex]).max() < 1e-9


def test_arrays_can_be_replaced(torus):
    surface = stages.surface(torus)
    slices = stages.slices(surface)
    points = stages.skeletal_points(surface, slices)
    view = points.points
    with pytest.raises(ValueError):
        view[0] = 0
    points.points = np.asarray(view) * 0.5
    assert np.array_equal(view, points.points)  # a view shows what the object holds
    with pytest.raises(mspskel.UsageError, match="points: expected"):
        points.points = np.zeros((3, 3))
    del points
    assert np.isfinite(view).all()  # and keeps it alive


def test_stages_of_another_surface_are_refused(torus, quadruped):
    slices = stages.slices(stages.surface(torus))
    with pytest.raises(mspskel.UsageError, match="made on a surface of"):
        stages.skeletal_points(stages.surface(quadruped), slices)
    with pytest.raises(mspskel.UsageError, match="vertex"):
        stages.surface(torus).contour(slices, 10**6)


def test_thesis_slices_by_sampling(torus):
    surface = stages.surface(torus)
    first = stages.minimum_slices(surface, mode="thesis", slices=4)
    more = stages.minimum_slices(surface, mode="thesis", slices=16)
    assert (more.perimeter <= first.perimeter + 1e-12).all()  # every plane of the first is among the second's


def test_coarsening(quadruped):
    surface = stages.surface(quadruped)
    coarse, owner = stages.coarsen(surface, coarse_vertices=800)
    assert len(coarse.points) < len(surface.points) == len(owner)
    assert set(owner) == set(range(len(coarse.points)))


def test_what_a_run_keeps(ring, torus):
    kept = ring.stages
    assert np.array_equal(kept.vertices, torus[0])
    assert np.array_equal(np.sort(kept.faces, axis=1), np.sort(torus[1], axis=1))
    assert kept.msp.shape == kept.slice_error.shape == (len(torus[0]),) and (kept.msp > 0).all()
    assert np.allclose(np.linalg.norm(kept.slice_normal, axis=1), 1)
    contour = kept.slice(7)
    length = np.linalg.norm(contour - np.roll(contour, 1, axis=0), axis=1).sum()
    assert length == pytest.approx(kept.msp[7], rel=0.01)  # its slices are of a surface that is coarser
    assert kept.vertex_of_point is None and len(kept.seconds) > 3
    with pytest.raises(mspskel.UsageError):
        kept.slice(-1)


def test_measures(ring):
    assert ring.certificate["topology"] == "proved" and ring.certificate["genus"] == [1]
    assert 0 < ring.coverage["mean"] < ring.coverage["p95"] < 0.05
    checks = ring.check()
    assert checks["topology"] and checks["contained"]
    moved = ring.copy()
    moved.swc["x"] += 100.0
    assert not moved.check()["contained"]
    assert ring.report["options"]["mode"] == "default" and ring.report["skeleton"]["cycles"] == 1


def test_points_keep_their_numbers_where_shells_are_united(quadruped):
    """Two creatures that cross become one surface, whose vertices stand for the points."""
    points, faces = quadruped
    both = np.concatenate([points, points + [0.1, 0.05, 0.02]])
    run = mspskel.skeletonize((both, np.concatenate([faces, faces + len(points)]))).stages
    kept = run.vertex_of_point >= 0
    assert len(kept) == len(both) and len(run.vertices) != len(both)
    away = np.linalg.norm(run.vertices[run.vertex_of_point[kept]] - both[kept], axis=1)
    assert kept.any() and away.max() < 0.1 * np.ptp(both, axis=0).max()
