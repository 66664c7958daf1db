"""The real packages whose names the skeleton has: their code runs on ours."""

import numpy as np
import pytest

import mspskel


def test_trimesh_in_and_out(ring, torus):
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(*torus, process=False)
    skeleton = mspskel.skeletonize(mesh)
    assert skeleton.mesh is mesh and np.array_equal(skeleton.vertices, ring.vertices)
    assert isinstance(ring.mesh, trimesh.Trimesh) and ring.mesh.is_watertight
    path = ring.skeleton
    assert isinstance(path, trimesh.path.Path3D) and path.length == pytest.approx(ring.cable_length())
    assert len(ring.scene(mesh=True).geometry) == 2


def test_code_for_skeletor_gives_the_same_answers(animal, tmp_path):
    skeletor = pytest.importorskip("skeletor")
    theirs = skeletor.Skeleton(animal.swc.copy(), mesh=animal.mesh, mesh_map=animal.mesh_map.copy())
    for name in ("vertices", "edges", "radius", "roots"):
        assert np.array_equal(getattr(theirs, name), getattr(animal, name)), name
    assert theirs.leafs.equals(animal.leafs)
    assert all(np.array_equal(a, b) for a, b in zip(theirs.skel_map, [m for m in animal.skel_map if len(m)]))
    assert theirs.get_graph().edges == animal.get_graph().edges
    for weight in ("weight", None):
        segments, lengths = animal.get_segments(weight, return_lengths=True)
        their_segments, their_lengths = theirs.get_segments(weight, return_lengths=True)
        assert np.allclose(lengths, their_lengths)
        assert sorted(map(len, segments)) == sorted(map(len, their_segments))
    root = int(animal.leafs.index[-1])
    assert theirs.reroot(root).swc.equals(animal.reroot(root).swc)
    assert np.allclose(theirs.skeleton.length, animal.skeleton.length)
    assert theirs.reindex().swc.shape == animal.reindex().swc.shape
    theirs.save_swc(tmp_path / "theirs.swc")
    animal.save_swc(tmp_path / "ours.swc")


def test_skeletors_post_processing_runs_on_ours(animal):
    skeletor = pytest.importorskip("skeletor")
    skeleton = animal.copy()
    for step in (
        lambda s: skeletor.post.smooth(s, inplace=False),
        lambda s: skeletor.post.despike(s, inplace=False),
        lambda s: skeletor.post.remove_bristles(s, inplace=False),
        lambda s: skeletor.post.clean_up(s, inplace=False),
        lambda s: skeletor.post.radii(s, method="knn", n=3) or s,
    ):
        skeleton = step(skeleton)
        assert isinstance(skeleton, mspskel.Skeleton) and len(skeleton) > 10


def test_navis_reads_ours(animal):
    navis = pytest.importorskip("navis")
    neuron = navis.TreeNeuron(animal.swc.copy())
    assert neuron.n_nodes == len(animal) and neuron.n_trees == len(animal.roots)
    assert neuron.n_leafs == len(animal.end_points)
    assert float(neuron.cable_length) == pytest.approx(animal.cable_length(), rel=1e-4)
    assert navis.TreeNeuron(animal.get_graph()).n_nodes == len(animal)


def test_navis_meshes_are_taken(ring, torus):
    navis = pytest.importorskip("navis")
    assert np.array_equal(mspskel.skeletonize(navis.MeshNeuron(torus)).vertices, ring.vertices)


def test_networkx_measures_ours(ring):
    networkx = pytest.importorskip("networkx")
    assert len(networkx.cycle_basis(ring.to_networkx())) == 1
    lengths = networkx.get_edge_attributes(ring.get_graph(), "weight").values()
    (a, b) = ring.edges[-1]
    cut = np.linalg.norm(ring.vertices[a] - ring.vertices[b])
    assert sum(lengths) + cut == pytest.approx(ring.cable_length())


@pytest.mark.parametrize("fixture", ["animal", "ring"])
def test_osteoid_reads_our_bytes(fixture, request):
    osteoid = pytest.importorskip("osteoid")
    ours = request.getfixturevalue(fixture)
    theirs = osteoid.Skeleton.from_precomputed(ours.to_precomputed())
    assert np.array_equal(theirs.vertices, ours.vertices.astype("f4"))
    assert np.array_equal(theirs.radii, ours.radii.astype("f4"))
    assert np.array_equal(np.sort(theirs.terminals()), ours.terminals())
    assert np.array_equal(np.sort(theirs.branches()), ours.branches())
    assert theirs.cable_length() == pytest.approx(ours.cable_length(), rel=1e-5)
    if len(ours.terminals()):  # osteoid's own paths begin at one
        assert len(theirs.interjoint_paths()) == len(ours.interjoint_paths())
    back = mspskel.Skeleton.from_precomputed(theirs.to_precomputed())
    assert len(back) == len(ours) and len(back.cycles) == len(ours.cycles)


def test_meshio_meshes_are_taken(ring, torus):
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(torus[0], [("triangle", torus[1])])
    assert np.array_equal(mspskel.skeletonize(mesh).vertices, ring.vertices)
