"""The names of skeletor, osteoid and MeshParty, by laws that hold for every skeleton."""

import pickle

import numpy as np
import pytest

import mspskel

pandas = pytest.importorskip("pandas")
networkx = pytest.importorskip("networkx")


@pytest.fixture(params=["animal", "ring"])
def skeleton(request):
    return request.getfixturevalue(request.param).copy()


def test_the_table_is_a_forest(skeleton):
    swc = skeleton.swc
    assert list(swc.columns) == ["node_id", "parent_id", "x", "y", "z", "radius"]
    graph = skeleton.get_graph()
    assert networkx.is_forest(graph.to_undirected()) and graph.number_of_nodes() == len(swc)
    assert (swc.parent_id < 0).sum() == len(skeleton.roots) == networkx.number_weakly_connected_components(graph)


def test_edges_are_the_forest_and_the_cuts(skeleton):
    tree = skeleton.swc[skeleton.swc.parent_id >= 0]
    assert len(skeleton.edges) == len(tree) + len(skeleton.cycles)
    graph = skeleton.to_networkx()
    assert graph.number_of_edges() - graph.number_of_nodes() + 1 == len(skeleton.cycles)


def test_cycles_go_round(ring):
    (cycle,) = ring.cycles
    edges = {frozenset(edge) for edge in ring.edges.tolist()}
    assert len(set(cycle.tolist())) == len(cycle) > 2
    assert all(frozenset(pair) in edges for pair in zip(cycle.tolist(), np.roll(cycle, 1).tolist()))


def test_what_is_changed_in_the_table_shows(animal):
    skeleton = animal.copy()
    skeleton.swc.loc[0, "x"] = 1e3
    skeleton.swc["radius"] = 2.0
    assert skeleton.vertices[0, 0] == 1e3 and (skeleton.radii == 2).all()
    assert animal.vertices[0, 0] != 1e3
    # Where a loop was cut, a leaf of the tree has two edges.
    end = next(i for i in reversed(skeleton.leafs.index) if (skeleton.edges == i).sum() == 1)
    skeleton.swc = skeleton.swc[skeleton.swc.node_id != skeleton.leafs.node_id[end]]
    assert len(skeleton) == len(animal) - 1 and len(skeleton.edges) == len(animal.edges) - 1


def test_reroot(skeleton):
    new = int(skeleton.leafs.index[-1])
    moved = skeleton.reroot(new)
    assert new in moved.roots and len(moved.roots) == len(skeleton.roots)
    assert {frozenset(e) for e in moved.edges.tolist()} == {frozenset(e) for e in skeleton.edges.tolist()}
    assert skeleton.reroot(int(skeleton.roots[0])).swc.equals(skeleton.swc)
    with pytest.raises(ValueError):
        skeleton.reroot(10**6)


def test_reindex(skeleton):
    result = skeleton.reroot(int(skeleton.leafs.index[-1])).reindex()
    swc = result.swc
    assert (swc.node_id == np.arange(len(swc))).all() and (swc.parent_id < swc.node_id).all()
    assert result.cable_length() == pytest.approx(skeleton.cable_length())
    before, after = skeleton.vertices[skeleton.mesh_map], result.vertices[result.mesh_map]
    assert np.array_equal(before, after)


def test_segments_cover_every_edge_once(skeleton):
    for weight in ("weight", None):
        segments, lengths = skeleton.get_segments(weight, return_lengths=True)
        assert lengths == sorted(lengths, reverse=True)
        edges = [pair for s in segments for pair in zip(s[:-1], s[1:])]
        assert sorted(edges) == sorted(map(tuple, skeleton.edges[: len(edges)].tolist()))
    assert skeleton.get_segments() == skeleton.get_segments(return_lengths=True)[0]


def test_maps_are_inverse(skeleton):
    for node, vertices in enumerate(skeleton.skel_map):
        assert (skeleton.mesh_map[vertices] == node).all()
    assert sum(map(len, skeleton.skel_map)) == len(skeleton.mesh_map)


def test_osteoid_counts(skeleton):
    degree = dict(skeleton.to_networkx().degree())
    assert sorted(skeleton.terminals()) == sorted(v for v, d in degree.items() if d == 1)
    assert sorted(skeleton.branches()) == sorted(v for v, d in degree.items() if d > 2)
    covered = [frozenset(p) for c in skeleton.interjoint_paths(True) for p in zip(c[:-1].tolist(), c[1:].tolist())]
    assert sorted(map(sorted, covered)) == sorted(map(sorted, skeleton.edges.tolist()))
    assert [len(p) for p in skeleton.paths()] == [len(p) for p in skeleton.paths(True)]
    assert skeleton.vertex_types.dtype == np.uint8
    assert len(skeleton.components()) == len(skeleton.roots)


def test_precomputed_there_and_back(skeleton):
    back = mspskel.Skeleton.from_precomputed(skeleton.to_precomputed())
    assert np.array_equal(back.vertices, skeleton.vertices.astype("f4"))
    assert np.array_equal(back.radii, skeleton.radii.astype("f4"))
    assert {frozenset(e) for e in back.edges.tolist()} == {frozenset(e) for e in skeleton.edges.tolist()}
    for size in (0, 7, 20):
        with pytest.raises(mspskel.ReadError):
            mspskel.Skeleton.from_precomputed(skeleton.to_precomputed()[:size])


def test_downsample_keeps_the_graph(skeleton):
    thin = skeleton.downsample(5)
    assert len(thin) < len(skeleton) and len(thin.cycles) == len(skeleton.cycles)
    assert len(thin.terminals()) == len(skeleton.terminals())
    assert len(skeleton.downsample(1)) == len(skeleton)
    assert len(skeleton.downsample(10**6).cycles) == len(skeleton.cycles)
    with pytest.raises(ValueError):
        skeleton.downsample(0.5)


def test_pieces():
    vertices, faces = mspskel.sample("torus", resolution=200)
    two = (np.concatenate([vertices, vertices + 10]), np.concatenate([faces, faces + len(vertices)]))
    skeleton = mspskel.skeletonize(two)
    pieces = skeleton.components()
    assert [len(p.cycles) for p in pieces] == [1, 1] and sum(map(len, pieces)) == len(skeleton)


def test_meshparty(skeleton):
    pytest.importorskip("scipy")
    from scipy.sparse.csgraph import dijkstra

    distance = dijkstra(skeleton.csgraph, directed=False, indices=skeleton.root)
    assert np.allclose(distance, skeleton.distance_to_root)
    assert sorted(np.concatenate(skeleton.segments)) == list(range(len(skeleton)))
    assert all((skeleton.segment_map[s] == i).all() for i, s in enumerate(skeleton.segments))
    path = skeleton.path_to_root(skeleton.end_points[0])
    assert path[0] == skeleton.end_points[0] and path[-1] == skeleton.root
    assert skeleton.mesh_to_skel_map is skeleton.mesh_map
    assert skeleton.n_vertices == len(skeleton)
    assert np.array_equal(skeleton.root_position, skeleton.vertices[skeleton.root])


def test_copies_and_pickles(skeleton):
    assert skeleton.clone().certificate == skeleton.certificate
    back = pickle.loads(pickle.dumps(skeleton))
    assert np.array_equal(back.vertices, skeleton.vertices) and np.array_equal(back.edges, skeleton.edges)
    assert np.array_equal(back.mesh.vertices, skeleton.mesh.vertices)
    with pytest.raises(mspskel.UsageError, match="does not come from skeletonize"):
        back.check()


def test_made_by_hand():
    pytest.importorskip("scipy")
    triangle = mspskel.Skeleton(np.eye(3), [[0, 1], [1, 2], [2, 0]])
    assert len(triangle.cycles) == 1 and triangle.cable_length() == pytest.approx(3 * np.sqrt(2))
    with pytest.raises(mspskel.UsageError):
        mspskel.Skeleton(np.eye(3), [[0, 3]])
    empty = mspskel.Skeleton(np.zeros((0, 3)), np.zeros((0, 2), int))
    assert empty.empty() and empty.cycles == [] and empty.paths() == [] and empty.to_networkx().order() == 0
    assert len(empty.swc) == 0 and empty.downsample(2).empty() and empty.components() == []


def test_mend_breaks_leaves_a_whole_skeleton_alone(animal):
    edges, vertices = animal.mend_breaks()
    assert len(edges) == len(animal.edges) and np.array_equal(vertices, animal.vertices)


def test_mend_breaks_closes_a_break(animal):
    broken = animal.copy()
    swc = broken.swc
    middle = int(swc.index[(swc.parent_id >= 0) & swc.node_id.isin(swc.parent_id)][5])
    swc.loc[middle, "parent_id"] = -1
    assert len(broken.components()) == 2
    edges, _ = broken.mend_breaks()
    assert networkx.is_connected(networkx.Graph(edges.tolist()))
